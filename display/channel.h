/// The video channel: an OSMesa context whose frame buffer is memory of ours, so that the image generator writes into
/// it directly.
#pragma once

#include <cstddef>
#include <memory>

#include "ig_core/view.h"

namespace quadrig::display {

/// Rows of a channel's frame buffer begin at multiples of this many bytes, a cache line.
inline constexpr std::size_t kRowAlignment = 64;

/// An OSMesa context and its frame buffer, RGBA8, top row first. GL drawing reaches the memory at glFinish(), and then
/// overwrites all of it; a channel that the image generator draws into must therefore not be drawn into with GL.
/// Not copyable. Make and use GL of one channel on one thread; the memory may be written from any.
class Channel {
  public:
    /// Throws std::runtime_error where OSMesa has no context to give or does not take the size (1..16384 each way).
    Channel(int width, int height);
    ~Channel();
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    /// The frame buffer itself, black and opaque at first. Valid as long as the channel.
    [[nodiscard]] FrameImage image() const;
    /// Makes this channel the calling thread's GL context. Throws std::runtime_error where OSMesa refuses.
    void make_current();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrig::display
