/// The sink `png:DIRECTORY`: one PNG file per frame, frame-000000.png by frame number.
#pragma once

#include <filesystem>

#include "display/frame_writer.h"

namespace quadrig::display {

class PngWriter : public FrameWriter {
  public:
    /// Makes the directory where it is missing. Throws std::runtime_error where it cannot be made or written to.
    explicit PngWriter(std::filesystem::path directory);
    void write(const FrameImage& image, std::uint64_t number, const std::stop_token& closing) override;
    [[nodiscard]] bool usable_after_error() const override { return true; }

  private:
    std::filesystem::path directory_;
};

/// "frame-000042.png"; more digits where six do not hold the number.
std::string png_frame_name(std::uint64_t number);

}  // namespace quadrig::display
