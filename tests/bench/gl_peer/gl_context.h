/// An OSMesa context for modern GL, and the few GL objects that the peer is made of.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "ig_core/view.h"

namespace quadrig::gl_peer {

/// GL 4.5 core through OSMesa into memory of its own, RGBA8, top row first in image(). Current on the thread that made
/// it until it is destroyed.
class GlContext {
  public:
    /// Throws std::runtime_error where OSMesa has no such context or does not take the size.
    GlContext(int width, int height);
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    void make_current() const;
    /// What glFinish() has put into memory.
    [[nodiscard]] FrameImage image();
    /// GL's name for what draws: "llvmpipe (LLVM 15.0.6, 256 bits)".
    [[nodiscard]] std::string renderer() const;

  private:
    struct Deleter {
        void operator()(void* context) const;
    };
    int width_, height_;
    std::vector<std::uint8_t> pixels_;
    std::unique_ptr<void, Deleter> context_;
};

/// Compiles and links a program of files in shaders/, `defines` among "PLANES", "GENERAL", "HOLES", "LAST", "FORWARD".
/// Both stages see frame.glsl; `fragment` is put together from several files, the last one with main(). Blocks Frame
/// and Textures are bound to 0 and 1, samplers `objects`, `planes`, `seen` and `picture` to units 0 to 3. Throws
/// std::runtime_error with the compiler's words.
unsigned make_program(const std::string& vertex, std::initializer_list<std::string> fragment,
                      const std::vector<std::string>& defines);

/// A texture buffer of vec4s on a texture unit, filled anew every frame.
class RecordBuffer {
  public:
    explicit RecordBuffer(unsigned unit);
    void fill(const float* values, std::size_t floats);

  private:
    unsigned buffer_ = 0;
};

/// A frame buffer of its own: one colour texture on a texture unit, and a depth buffer (0 for none).
struct Target {
    unsigned frame_buffer = 0, colour = 0;
};
Target make_target(int width, int height, unsigned colour_format, unsigned unit, unsigned depth);
/// 32-bit floating point depth.
unsigned make_depth(int width, int height);

}  // namespace quadrig::gl_peer
