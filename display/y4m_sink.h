/// The sink `y4m:FILE`: uncompressed video that ffmpeg, mpv and the encoders read (YUV4MPEG2), to a file, a pipe or
/// standard output.
///
/// Pixels are Y'CbCr 4:4:4, 8 bits, ITU-R BT.601 matrix: what readers assume of a stream that cannot name its matrix.
/// Full range, said by XCOLORRANGE=FULL, so that a picture comes back within 2 of 255.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "display/frame_writer.h"

namespace quadrig::display {

/// The stream header, its newline included.
std::string y4m_header(const VideoFormat& format);

/// Fills three planes of width * height bytes each, Y', Cb, Cr one behind the other, each value rounded to the nearest.
/// Source: ITU-R BT.601-7, 2.5.1 to 2.5.4, with the full range 0..255 of JFIF 1.02.
void ycbcr_from_rgb(const FrameImage& image, std::span<std::uint8_t> planes);

class Y4mWriter : public FrameWriter {
  public:
    /// `file` is a path, or "-" for standard output. Throws std::runtime_error where it cannot be opened for writing.
    Y4mWriter(const std::string& file, const VideoFormat& format);
    ~Y4mWriter() override;
    Y4mWriter(const Y4mWriter&) = delete;
    Y4mWriter& operator=(const Y4mWriter&) = delete;
    void write(const FrameImage& image, std::uint64_t number, const std::stop_token& closing) override;
    void finish() override;
    [[nodiscard]] bool usable_after_error() const override { return false; }

  private:
    void write_all(std::span<const std::uint8_t> bytes, const std::stop_token& closing) const;
    [[noreturn]] void fail(const std::string& reason) const;

    std::string name_;
    int descriptor_ = -1;
    bool may_block_ = false;
    std::size_t frame_start_ = 0;  ///< where "FRAME\n" begins in buffer_: behind the stream header
    bool header_written_ = false;
    std::vector<std::uint8_t> buffer_;  ///< stream header, "FRAME\n", planes
};

}  // namespace quadrig::display
