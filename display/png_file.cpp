#include "display/png_file.h"

#include <png.h>
#include <zlib.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

#include "display/atomic_file.h"

namespace quadrig::display {

namespace {

/// What libpng said when it gave up, copied out of its longjmp.
struct Complaint {
    char text[128] = "unknown error";
};

void on_error(png_structp png, png_const_charp message) {
    std::snprintf(static_cast<Complaint*>(png_get_error_ptr(png))->text, sizeof Complaint::text, "%s", message);
    png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

/// Everything between setjmp and a possible longjmp: no object with a destructor may live here.
bool encode(png_structp png, png_infop info, std::FILE* stream, const FrameImage& image, PngCompression compression) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, stream);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (compression == PngCompression::fast) {
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
        png_set_compression_level(png, 1);
        png_set_compression_strategy(png, Z_RLE);
    } else {
        png_set_compression_level(png, 6);
    }
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    for (int r = 0; r < image.height; ++r) png_write_row(png, image.row(r));
    png_write_end(png, nullptr);
    return true;
}

/// Writes a whole file to a stream; `name` is what an error is about.
void write_png(std::FILE* stream, const std::string& name, const FrameImage& image, PngCompression compression) {
    Complaint complaint;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    const bool written = info && encode(png, info, stream, image, compression);
    // Of a stream that takes no more libpng says only "Write Error"; the system says why.
    const std::string reason = std::ferror(stream) != 0 ? std::strerror(errno) : complaint.text;
    png_destroy_write_struct(&png, &info);
    if (!written) throw std::runtime_error(name + ": cannot be written: " + reason);
}

}  // namespace

void write_png(const std::filesystem::path& path, const FrameImage& image, PngCompression compression) {
    AtomicFile file(path);
    write_png(file.stream(), path.string(), image, compression);
    file.commit();
}

std::string png_bytes(const FrameImage& image, PngCompression compression) {
    struct Memory {
        char* bytes = nullptr;
        std::size_t size = 0;
        std::FILE* stream = open_memstream(&bytes, &size);
        Memory() = default;
        Memory(const Memory&) = delete;
        Memory& operator=(const Memory&) = delete;
        ~Memory() {
            if (stream != nullptr) std::fclose(stream);
            std::free(bytes);
        }
    } memory;
    if (memory.stream == nullptr) throw std::bad_alloc();
    write_png(memory.stream, "picture", image, compression);
    if (std::fflush(memory.stream) != 0) throw std::bad_alloc();
    return {memory.bytes, memory.size};
}

Picture read_png(const std::filesystem::path& path) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    Picture picture;
    if (png_image_begin_read_from_file(&png, path.c_str())) {
        png.format = PNG_FORMAT_RGBA;
        picture = Picture(static_cast<int>(png.width), static_cast<int>(png.height));
        if (png_image_finish_read(&png, nullptr, picture.pixels.data(), 4 * picture.width, nullptr)) return picture;
    }
    const std::string reason = png.message;
    png_image_free(&png);
    throw std::runtime_error(path.string() + ": cannot be read: " + reason);
}

}  // namespace quadrig::display
