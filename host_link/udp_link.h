/// A live link over UDP: a socket and a thread that feeds what it hears to a Session.
#pragma once

#include <array>
#include <atomic>

#include "host_link/live_link.h"
#include "host_link/sockets.h"
#include "host_link/trust.h"

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
    /// Where anybody may reach the link, no more bytes go back than came, of which so many are remembered.
    static constexpr std::uint64_t kMostCredit = 65536;

    /// To a CIGI host: Start Of Frame for this frame, with the answers that are ready, as many as a message holds, to
    /// where the URL says or the state last taken came from. Does nothing before that.
    void send_start_of_frame(std::uint32_t ig_frame, Time now, bool overframing = false);
    /// Overframing is told where a deadline was missed since the frame before.
    void frame_begins(const FrameStatus& status) override;

    /// In synchronous operation: frames that began without an answer to the Start Of Frame before.
    [[nodiscard]] std::uint64_t unanswered() const override { return unanswered_.load(std::memory_order_relaxed); }

    [[nodiscard]] std::string place() const override { return "port " + std::to_string(port()); }
    [[nodiscard]] std::uint16_t port() const override;

  private:
    struct Batch;

    void receive() override;
    void accept_batch(Batch& batch, int count);

    void queue(std::span<const Session::Response> responses);

    [[nodiscard]] std::size_t largest_reply(std::uint64_t bytes_taken);
    void append(const Session::Response& response, std::size_t& size);
    void keep(const Session::Response& message);
    void append_message(std::uint64_t bytes_taken, std::size_t largest, std::size_t& size);
    void look_for_answer();

    Descriptor socket_;
    PeerGate gate_;                  ///< the link's thread's
    std::uint64_t bytes_taken_ = 0;  ///< the link's thread's
    // From the link's thread to the frame loop, wait-free on both sides.
    std::array<Session::Response, kMostWaiting> waiting_{};
    std::atomic<std::size_t> queued_{0}, taken_{0};
    // The frame loop's.
    std::array<std::byte, kLargestMessage> message_{};
    ReplyRate reply_rate_;
    std::optional<Peer> reply_to_;
    bool open_;  ///< anybody may reach the link
    std::uint64_t bytes_answered_ = 0;
    /// Messages that nobody asked for wait until as many bytes have come as they have.
    InplaceVector<Session::Response, 8> kept_;
    std::uint64_t bytes_at_last_message_ = 0;
    std::uint64_t heard_at_last_frame_ = 0;
    bool told_of_last_frame_ = false;
    std::atomic<std::uint64_t> unanswered_{0};
    std::uint32_t misses_ = 0;
};

}  // namespace quadrig::host
