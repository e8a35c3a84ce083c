/// A recording played into a session, by the recording's own clock.
#pragma once

#include <cstddef>

#include "host_link/capture.h"
#include "host_link/session.h"

namespace quadrig::appliance {

class Playback {
  public:
    /// Plays up to the first pose. `capture` must outlive this. Throws std::runtime_error where there is no pose, with
    /// the reasons why datagrams were refused.
    Playback(const host::Capture& capture, const host::SessionOptions& options);

    /// Capture times of the first pose and of the latest datagram.
    [[nodiscard]] host::Time begin() const { return begin_; }
    [[nodiscard]] host::Time end() const { return end_; }

    /// Plays what was captured until `time` and gives the state then. Times before the last one asked for give that
    /// one's state. Allocates nothing.
    const host::HostState& state_at(host::Time time);
    [[nodiscard]] const host::HostState& state() const { return session_.state(); }
    [[nodiscard]] const host::LinkStatistics& statistics() const { return session_.statistics(); }

  private:
    host::Verdict play_next();

    const host::Capture& capture_;
    host::Session session_;
    std::size_t next_ = 0;
    host::Time begin_{}, end_{};
};

}  // namespace quadrig::appliance
