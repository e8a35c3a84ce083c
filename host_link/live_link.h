/// A live link: a thread that feeds what it hears to a Session, and a mailbox that the frame loop empties.
#pragma once

#include <sys/socket.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "host_link/host_state.h"
#include "host_link/link_statistics.h"
#include "host_link/link_url.h"
#include "host_link/mailbox.h"
#include "host_link/recording.h"
#include "host_link/session.h"
#include "host_link/sockets.h"

namespace quadrig::host {

/// What the image generator tells its hosts at a frame's start.
struct FrameStatus {
    std::uint32_t frame = 0;
    Time now{};
    std::uint32_t misses = 0;  ///< deadlines missed so far
};

/// Who calls what: one thread (the frame loop's) calls take_newest and frame_begins, which neither wait nor allocate;
/// any other thread may call statistics; start and stop belong to the owner. Arrival times are CLOCK_MONOTONIC, taken
/// by the kernel where it can.
class LiveLink {
  public:
    virtual ~LiveLink() = default;
    LiveLink(const LiveLink&) = delete;
    LiveLink& operator=(const LiveLink&) = delete;

    /// Everything heard from now on is given to `tap` too, on the link's thread, in the order in which the session sees
    /// it. Before start.
    using Tap = std::function<void(const Heard&)>;
    void record_to(Tap tap) { tap_ = std::move(tap); }

    /// Begins to receive. `options` come from session_options(url(), …). Once only.
    void start(const SessionOptions& options);
    /// Ends the thread; what was published stays. May be called twice.
    void stop();

    /// Whether something new came since the last call; `state` is written only then.
    bool take_newest(HostState& state);
    /// How much the session had heard when it published the state last taken. The frame loop's.
    [[nodiscard]] std::uint64_t heard() const { return latched_.heard; }
    /// Answers that are due once a frame, to the host that the state last taken came from.
    virtual void frame_begins(const FrameStatus&) {}

    /// A snapshot, also while running.
    [[nodiscard]] LinkStatistics statistics() const;
    [[nodiscard]] std::uint64_t replies_sent() const { return replies_sent_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint64_t replies_failed() const { return replies_failed_.load(std::memory_order_relaxed); }
    /// Replies that were due, but would have been too many or, where anybody may reach the link, too large.
    [[nodiscard]] std::uint64_t replies_held_back() const { return replies_held_back_.load(std::memory_order_relaxed); }
    /// Where the host is to answer every frame: frames that it has not answered when the next one began.
    [[nodiscard]] virtual std::uint64_t unanswered() const { return 0; }
    [[nodiscard]] const LinkUrl& url() const { return url_; }
    /// "port 8004", "interface vcan0".
    [[nodiscard]] virtual std::string place() const = 0;
    /// The bound one, also where the URL asked for any; 0 where there are no ports.
    [[nodiscard]] virtual std::uint16_t port() const { return 0; }

  protected:
    struct Peer {
        sockaddr_storage address{};
        socklen_t size = 0;
        std::uint64_t bytes_taken = 0;  ///< of all messages taken from anybody so far
    };
    struct News {
        HostState state;
        std::optional<ReplyContext> reply;
        Peer peer;
        std::uint64_t heard = 0;
    };

    explicit LiveLink(LinkUrl url);

    /// The thread's work: returns once wake_descriptor() is readable.
    virtual void receive() = 0;
    [[nodiscard]] int wake_descriptor() const { return wake_.fd; }

    /// Exclusive use of the session against statistics(); never the frame loop's.
    [[nodiscard]] std::unique_lock<std::mutex> lock_session() const { return std::unique_lock(session_mutex_); }
    /// With the session locked: folds it into the session, and tells the tap.
    Verdict hear(Heard heard);
    /// With the session locked: nothing more is heard of the connection that `heard` came over; it has no bytes.
    void connection_closes(Heard heard);
    /// With the session locked: what is heard next is another host's.
    void host_changes();
    Session& session() { return *session_; }
    void publish() { publish(Peer()); }
    void publish(const Peer& peer) {
        mailbox_.publish({session_->state(), session_->reply_context(), peer, session_->statistics().datagrams});
    }

    /// The frame loop's.
    [[nodiscard]] const News& latched() const { return latched_; }
    void count_reply(bool sent);
    void hold_reply_back() { replies_held_back_.fetch_add(1, std::memory_order_relaxed); }

  private:
    LinkUrl url_;
    Descriptor wake_;
    Tap tap_;
    std::uint32_t changes_ = 0;  ///< of the host since the tap was told last
    std::unique_ptr<Session> session_;
    mutable std::mutex session_mutex_;
    Mailbox<News> mailbox_;
    News latched_;
    std::atomic<std::uint64_t> replies_sent_{0};
    std::atomic<std::uint64_t> replies_failed_{0};
    std::atomic<std::uint64_t> replies_held_back_{0};
    std::thread thread_;
};

/// CLOCK_REALTIME, CLOCK_MONOTONIC.
Time clock_time(clockid_t clock);
/// When the kernel stamped a message (SO_TIMESTAMPNS), by CLOCK_MONOTONIC; `monotonic` where it did not. `realtime` and
/// `monotonic` are both clocks now: the first may be set, so the two are compared afresh each time.
Time arrival_time(msghdr& header, Time realtime, Time monotonic);

/// The link that a live URL names; from here on the kernel queues what hosts send. Throws std::runtime_error with the
/// URL and the system's reason.
std::unique_ptr<LiveLink> open_link(const LinkUrl& given);

}  // namespace quadrig::host
