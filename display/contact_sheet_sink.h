/// A sink that leaves one page with thumbnails of the whole run, evenly spaced, however long it turns out to be.
#pragma once

#include <filesystem>
#include <vector>

#include "display/frame_writer.h"
#include "display/picture.h"

namespace quadrig::display {

/// Keeps every frame at first; whenever kMost thumbnails are there, every other one goes, and from then on only every
/// second of the frames taken until then is. The page is written by finish().
class ContactSheetWriter : public FrameWriter {
  public:
    static constexpr int kColumns = 6, kMost = 36, kThumbnailWidth = 320;

    /// Throws std::runtime_error where the file cannot be made.
    ContactSheetWriter(std::filesystem::path file, const VideoFormat& format);
    void write(const FrameImage& image, std::uint64_t number, const std::stop_token& closing) override;
    /// Writes nothing where there was no frame.
    void finish() override;
    [[nodiscard]] bool usable_after_error() const override { return false; }

  private:
    std::filesystem::path file_;
    int width_, height_;  ///< of a thumbnail
    std::uint64_t seen_ = 0, stride_ = 1;
    std::vector<Picture> thumbnails_;
};

}  // namespace quadrig::display
