#include "display/channel.h"

#include <GL/osmesa.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#if defined(__SANITIZE_ADDRESS__)
// Mesa 22.3 never frees the small record it keeps of a context's last buffer.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
#endif

namespace quadrig::display {

namespace {

constexpr int kBytesPerPixel = 4;

std::size_t padded_row_bytes(int width) {
    const std::size_t bytes = static_cast<std::size_t>(width) * kBytesPerPixel;
    return (bytes + kRowAlignment - 1) / kRowAlignment * kRowAlignment;
}

}  // namespace

struct Channel::Impl {
    struct ContextDeleter {
        void operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }
    };
    struct AlignedDeleter {
        void operator()(std::uint8_t* memory) const { std::free(memory); }
    };

    int width, height;
    std::size_t row_bytes;
    // The context is destroyed before the memory it draws into.
    std::unique_ptr<std::uint8_t, AlignedDeleter> pixels;
    std::unique_ptr<osmesa_context, ContextDeleter> context;
};

Channel::Channel(int width, int height) {
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    constexpr int kLargest = 16384;
    if (width < 1 || height < 1 || width > kLargest || height > kLargest)
        throw std::runtime_error("video channel: " + size + " is not a picture size (1 to 16384 each way)");
    impl_ = std::make_unique<Impl>(Impl{width, height, padded_row_bytes(width), nullptr, nullptr});
    const std::size_t bytes = impl_->row_bytes * static_cast<std::size_t>(height);
    impl_->pixels.reset(static_cast<std::uint8_t*>(std::aligned_alloc(kRowAlignment, bytes)));
    if (!impl_->pixels) throw std::bad_alloc();
    constexpr std::array<std::uint8_t, kBytesPerPixel> kBlack{0, 0, 0, 255};
    for (std::size_t i = 0; i < bytes; i += kBytesPerPixel) std::ranges::copy(kBlack, impl_->pixels.get() + i);
    impl_->context.reset(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr));
    if (!impl_->context) throw std::runtime_error("video channel: OSMesa gives no context");
    make_current();
}

Channel::~Channel() {
    if (impl_ && OSMesaGetCurrentContext() == impl_->context.get()) OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
}

FrameImage Channel::image() const {
    return {impl_->pixels.get(), impl_->width, impl_->height, static_cast<std::ptrdiff_t>(impl_->row_bytes)};
}

void Channel::make_current() {
    const Impl& c = *impl_;
    if (!OSMesaMakeCurrent(c.context.get(), c.pixels.get(), GL_UNSIGNED_BYTE, c.width, c.height))
        throw std::runtime_error("video channel: OSMesa refuses a frame buffer of " + std::to_string(c.width) + "x" +
                                 std::to_string(c.height));
    OSMesaPixelStore(OSMESA_ROW_LENGTH, static_cast<GLint>(c.row_bytes / kBytesPerPixel));
    OSMesaPixelStore(OSMESA_Y_UP, 0);
}

}  // namespace quadrig::display
