/// A live link over UDP: a socket and a thread that feeds what it hears to a Session.
#pragma once

#include <array>
#include <atomic>

#include "host_link/live_link.h"

namespace quadrig::host {

class UdpLink final : public LiveLink {
  public:
    /// Binds; from here on datagrams queue up in the kernel. Throws std::runtime_error with the URL and the system's
    /// reason.
    explicit UdpLink(LinkUrl url);
    ~UdpLink() override { stop(); }

    /// Answers that wait for the next Start Of Frame, and the largest message that carries them.
    static constexpr std::size_t kMostWaiting = 1024;
    static constexpr std::size_t kLargestMessage = 4096;

    /// To a CIGI host: Start Of Frame for this frame, with the answers that are ready, as many as a message holds, to
    /// where the state last taken came from. Does nothing before that.
    void send_start_of_frame(std::uint32_t ig_frame, Time now);
    void frame_begins(const FrameStatus& status) override { send_start_of_frame(status.frame, status.now); }

    [[nodiscard]] std::string place() const override { return "port " + std::to_string(port()); }
    [[nodiscard]] std::uint16_t port() const override;

  private:
    struct Batch;

    void receive() override;
    void accept_batch(Batch& batch, int count);

    void queue(std::span<const Session::Response> responses);

    Descriptor socket_;
    // From the link's thread to the frame loop, wait-free on both sides.
    std::array<Session::Response, kMostWaiting> waiting_{};
    std::atomic<std::size_t> queued_{0}, taken_{0};
    std::array<std::byte, kLargestMessage> message_{};  ///< the frame loop's
};

}  // namespace quadrig::host
