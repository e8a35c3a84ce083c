/// Pictures as PNG files (ISO/IEC 15948), through libpng: 8-bit RGB, marked as sRGB.
#pragma once

#include <filesystem>
#include <string>

#include "display/picture.h"
#include "ig_core/view.h"

namespace quadrig::display {

/// What a file's size is worth: `fast` is for one file per frame, `small` for a still picture.
enum class PngCompression { fast, small };

/// Writes the picture's colours; the frame buffer's constant alpha is left out. The file is whole or absent.
/// Throws std::runtime_error with the path and the reason.
void write_png(const std::filesystem::path& path, const FrameImage& image,
               PngCompression compression = PngCompression::small);

/// The same file as bytes in memory. Throws std::runtime_error with the reason.
std::string png_bytes(const FrameImage& image, PngCompression compression = PngCompression::small);

/// Reads any PNG as RGBA8. Throws std::runtime_error with the path and the reason.
Picture read_png(const std::filesystem::path& path);

}  // namespace quadrig::display
