#include "display/y4m_sink.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace quadrig::display {

namespace {

constexpr std::string_view kFrameMark = "FRAME\n";

constexpr int kFractionBits = 20;
constexpr std::int32_t fixed(double v) {
    return static_cast<std::int32_t>(v * (1 << kFractionBits) + (v < 0.0 ? -0.5 : 0.5));
}

/// Weights of R, G, B in one component; they add up exactly, so that greys have no colour.
struct Weights {
    std::int32_t r, g, b, offset;
};
constexpr double kRed = 0.299, kBlue = 0.114;
constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
constexpr Weights kLuma{fixed(kRed), (1 << kFractionBits) - fixed(kRed) - fixed(kBlue), fixed(kBlue), kHalf};
constexpr std::int32_t kMiddle = (128 << kFractionBits) + kHalf;
constexpr Weights kCb{fixed(-0.5 * kRed / (1.0 - kBlue)), -fixed(0.5) - fixed(-0.5 * kRed / (1.0 - kBlue)), fixed(0.5),
                      kMiddle};
constexpr Weights kCr{fixed(0.5), -fixed(0.5) - fixed(-0.5 * kBlue / (1.0 - kRed)), fixed(-0.5 * kBlue / (1.0 - kRed)),
                      kMiddle};

/// One component of one row. The largest value, 255.5 before rounding, becomes 255.
void convert_row(const std::uint8_t* rgba, int width, const Weights& w, std::uint8_t* out) {
    for (int c = 0; c < width; ++c, rgba += 4) {
        const std::int32_t v = (w.r * rgba[0] + w.g * rgba[1] + w.b * rgba[2] + w.offset) >> kFractionBits;
        out[c] = static_cast<std::uint8_t>(std::min(v, 255));
    }
}

}  // namespace

std::string y4m_header(const VideoFormat& format) {
    return "YUV4MPEG2 W" + std::to_string(format.width) + " H" + std::to_string(format.height) + " F" +
           std::to_string(format.rate_numerator) + ":" + std::to_string(format.rate_denominator) +
           " Ip A1:1 C444 XCOLORRANGE=FULL\n";
}

void ycbcr_from_rgb(const FrameImage& image, std::span<std::uint8_t> planes) {
    const std::size_t width = static_cast<std::size_t>(image.width),
                      plane = width * static_cast<std::size_t>(image.height);
    for (int r = 0; r < image.height; ++r) {
        std::uint8_t* out = planes.data() + static_cast<std::size_t>(r) * width;
        convert_row(image.row(r), image.width, kLuma, out);
        convert_row(image.row(r), image.width, kCb, out + plane);
        convert_row(image.row(r), image.width, kCr, out + 2 * plane);
    }
}

Y4mWriter::Y4mWriter(const std::string& file, const VideoFormat& format) : name_("y4m:" + file) {
    const std::string header = y4m_header(format);
    buffer_.assign(header.begin(), header.end());
    frame_start_ = buffer_.size();
    buffer_.insert(buffer_.end(), kFrameMark.begin(), kFrameMark.end());
    buffer_.resize(buffer_.size() +
                   3 * static_cast<std::size_t>(format.width) * static_cast<std::size_t>(format.height));

    descriptor_ = file == "-" ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                              : open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(std::strerror(errno));
    struct stat kind {};
    may_block_ = fstat(descriptor_, &kind) == 0 && !S_ISREG(kind.st_mode);
}

Y4mWriter::~Y4mWriter() {
    if (descriptor_ >= 0) close(descriptor_);
}

void Y4mWriter::write(const FrameImage& image, std::uint64_t, const std::stop_token& closing) {
    ycbcr_from_rgb(image, std::span(buffer_).subspan(frame_start_ + kFrameMark.size()));
    write_all(std::span(buffer_).subspan(header_written_ ? frame_start_ : 0), closing);
    header_written_ = true;
}

void Y4mWriter::finish() {
    // A stream without frames is still a stream.
    if (!header_written_) write_all(std::span(buffer_).first(frame_start_), {});
    if (close(std::exchange(descriptor_, -1)) != 0) fail(std::strerror(errno));
}

void Y4mWriter::write_all(std::span<const std::uint8_t> bytes, const std::stop_token& closing) const {
    using Clock = std::chrono::steady_clock;
    constexpr auto kPatience = std::chrono::seconds(1);
    auto progress = Clock::now();
    while (!bytes.empty()) {
        std::size_t size = bytes.size();
        if (may_block_) {
            // A pipe that polls writable takes PIPE_BUF bytes without blocking; more could hold us for ever.
            size = std::min<std::size_t>(size, PIPE_BUF);
            pollfd writable{descriptor_, POLLOUT, 0};
            if (poll(&writable, 1, 100) <= 0) {
                if (closing.stop_requested() && Clock::now() - progress > kPatience)
                    fail("its reader has stopped reading");
                continue;
            }
        }
        const ssize_t written = ::write(descriptor_, bytes.data(), size);
        if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (written < 0) fail(errno == EPIPE ? "its reader has gone" : std::strerror(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        progress = Clock::now();
    }
}

void Y4mWriter::fail(const std::string& reason) const {
    throw std::runtime_error(name_ + ": cannot be written: " + reason);
}

}  // namespace quadrig::display
