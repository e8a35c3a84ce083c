/// A live link: a UDP socket and a thread that feeds what it hears to a Session.
#pragma once

#include <sys/socket.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "host_link/host_state.h"
#include "host_link/link_statistics.h"
#include "host_link/link_url.h"
#include "host_link/mailbox.h"
#include "host_link/session.h"

namespace quadrig::host {

/// Who calls what: one thread (the frame loop's) calls take_newest and send_start_of_frame, which neither wait nor
/// allocate; any other thread may call statistics; start and stop belong to the owner. Arrival times are
/// CLOCK_MONOTONIC, taken by the kernel when the datagram came in.
class UdpLink {
  public:
    /// Binds; from here on datagrams queue up in the kernel. Throws std::runtime_error with the URL and the system's
    /// reason.
    explicit UdpLink(LinkUrl url);
    ~UdpLink();
    UdpLink(const UdpLink&) = delete;
    UdpLink& operator=(const UdpLink&) = delete;

    /// Begins to receive. `options` come from session_options(url(), …).
    void start(const SessionOptions& options);
    /// Ends the thread; what was published stays. May be called twice.
    void stop();

    /// Whether something new came since the last call; `state` is written only then.
    bool take_newest(HostState& state);
    /// To a CIGI host: Start Of Frame for this frame, to where the state last taken came from. Does nothing before
    /// that.
    void send_start_of_frame(std::uint32_t ig_frame, Time now);

    /// A snapshot, also while running.
    [[nodiscard]] LinkStatistics statistics() const;
    [[nodiscard]] std::uint64_t replies_sent() const { return replies_sent_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint64_t replies_failed() const { return replies_failed_.load(std::memory_order_relaxed); }
    [[nodiscard]] const LinkUrl& url() const { return url_; }
    [[nodiscard]] std::uint16_t port() const;  ///< the bound one, also where the URL asked for any

  private:
    struct Peer {
        sockaddr_storage address{};
        socklen_t size = 0;
    };
    struct News {
        HostState state;
        std::optional<ReplyContext> reply;
        Peer peer;
    };
    struct Descriptor {
        int fd = -1;
        Descriptor() = default;
        explicit Descriptor(int f) : fd(f) {}
        ~Descriptor();
        Descriptor(const Descriptor&) = delete;
        Descriptor& operator=(const Descriptor&) = delete;
    };
    struct Batch;

    void receive();
    void accept_batch(Batch& batch, int count);

    LinkUrl url_;
    Descriptor socket_;
    Descriptor wake_;
    std::unique_ptr<Session> session_;
    mutable std::mutex session_mutex_;  ///< receiving thread against statistics(); never the frame loop
    Mailbox<News> mailbox_;
    News latched_;  ///< the frame loop's
    std::atomic<std::uint64_t> replies_sent_{0};
    std::atomic<std::uint64_t> replies_failed_{0};
    std::thread thread_;
};

}  // namespace quadrig::host
