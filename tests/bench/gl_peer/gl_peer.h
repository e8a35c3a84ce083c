/// A peer of the image generator: the same image model (ig_core/README.md) drawn by GL, with ray-cast quadric
/// impostors in GLSL, one sample a pixel. What it does and leaves out: tests/bench/README.md.
#pragma once

#include <memory>
#include <string>

#include "ig_core/view.h"

namespace quadrig::gl_peer {

/// When opaque surfaces are painted.
enum class Shading {
    deferred,  ///< once a pixel, after all are in their places: the faster one where much is hidden
    forward    ///< with their impostors, front to back
};

class GlPeer {
  public:
    /// Throws std::runtime_error where there is no GL 4.5, and for scenes with ground polygons, lights or more than 256
    /// textures, which the peer does not draw. Objects stay where they are at time 0.
    GlPeer(const Scene& scene, int width, int height, Shading shading = Shading::deferred);
    ~GlPeer();
    GlPeer(const GlPeer&) = delete;
    GlPeer& operator=(const GlPeer&) = delete;

    /// Draws a view of the size given, and comes back when the picture is in memory. On the thread that made the peer.
    FrameImage render(const View& view);
    [[nodiscard]] std::string renderer() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrig::gl_peer
