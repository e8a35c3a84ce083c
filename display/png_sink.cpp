#include "display/png_sink.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "display/png_file.h"

namespace quadrig::display {

PngWriter::PngWriter(std::filesystem::path directory) : directory_(std::move(directory)) {
    std::error_code error;
    std::filesystem::create_directories(directory_, error);
    if (!error && !std::filesystem::is_directory(directory_)) error = std::make_error_code(std::errc::not_a_directory);
    if (!error && access(directory_.c_str(), W_OK | X_OK) != 0) error = {errno, std::generic_category()};
    if (error)
        throw std::runtime_error("png:" + directory_.string() + ": no directory to write to: " + error.message());
}

void PngWriter::write(const FrameImage& image, std::uint64_t number, const std::stop_token&) {
    write_png(directory_ / png_frame_name(number), image, PngCompression::fast);
}

std::string png_frame_name(std::uint64_t number) {
    char name[40];
    std::snprintf(name, sizeof name, "frame-%06llu.png", static_cast<unsigned long long>(number));
    return name;
}

}  // namespace quadrig::display
