#include "display/contact_sheet_sink.h"

#include <algorithm>
#include <utility>

#include "display/atomic_file.h"
#include "display/contact_sheet.h"
#include "display/png_file.h"

namespace quadrig::display {

ContactSheetWriter::ContactSheetWriter(std::filesystem::path file, const VideoFormat& format)
    : file_(std::move(file)),
      width_(std::min(kThumbnailWidth, format.width)),
      height_(std::max(1, format.height * width_ / format.width)) {
    expect_writable(file_);
}

void ContactSheetWriter::write(const FrameImage& image, std::uint64_t, const std::stop_token&) {
    if (seen_++ % stride_ != 0) return;
    if (thumbnails_.size() == kMost) {
        for (std::size_t i = 1; 2 * i < thumbnails_.size(); ++i) thumbnails_[i] = std::move(thumbnails_[2 * i]);
        thumbnails_.resize(kMost / 2);
        stride_ *= 2;
        // kMost is even, so that this frame is one of those that the longer stride takes.
    }
    thumbnails_.emplace_back(width_, height_);
    scale_down(image, thumbnails_.back().image());
}

void ContactSheetWriter::finish() {
    if (thumbnails_.empty()) return;
    const int count = static_cast<int>(thumbnails_.size());
    ContactSheet sheet(std::min(kColumns, count), (count + kColumns - 1) / kColumns, width_, height_);
    for (Picture& thumbnail : thumbnails_) sheet.add(thumbnail.image());
    write_png(file_, sheet.image());
}

}  // namespace quadrig::display
