/// A recording played into a session, by the recording's own clock.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host_link/capture.h"
#include "host_link/recorded_frames.h"
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

/// A live run once more, frame by frame: each sees just what it saw then.
class RunAgain {
  public:
    /// Both must outlive this. Throws std::runtime_error where the recording lacks what its frames have seen.
    RunAgain(const host::Capture& capture, const host::SessionOptions& options, const host::RecordedFrames& frames);

    [[nodiscard]] std::uint64_t size() const { return frames_.frames.size(); }
    [[nodiscard]] const host::RecordedFrame& frame(std::uint64_t index) const { return frames_.frames[index]; }
    /// Frames come in their order.
    const host::HostState& state_at(std::uint64_t index);
    /// What came after the last frame.
    void play_rest() { play_to(capture_.datagrams.size()); }
    [[nodiscard]] const host::LinkStatistics& statistics() const { return session_.statistics(); }

  private:
    void play_to(std::uint64_t heard);

    const host::Capture& capture_;
    const host::RecordedFrames& frames_;
    host::Session session_;
    std::size_t next_ = 0, next_change_ = 0;
};

}  // namespace quadrig::appliance
