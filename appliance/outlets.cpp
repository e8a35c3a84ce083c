#include "appliance/outlets.h"

#include <algorithm>
#include <utility>

#include "display/contact_sheet.h"
#include "display/frame_hash.h"
#include "display/png_file.h"

namespace quadrig::appliance {
namespace {

constexpr int kSheetColumns = 4, kSheetRows = 4, kSheetPictures = kSheetColumns * kSheetRows;
constexpr int kThumbnailWidth = 320;

/// Collects pictures on a sink's thread and writes the page at the end.
class ContactSheetWriter : public display::FrameWriter {
  public:
    ContactSheetWriter(std::filesystem::path file, const display::VideoFormat& format, int rows)
        : file_(std::move(file)), sheet_(kSheetColumns, rows, width_of(format), height_of(format)) {}
    void write(const FrameImage& image, std::uint64_t, const std::stop_token&) override { sheet_.add(image); }
    void finish() override { display::write_png(file_, sheet_.image()); }
    [[nodiscard]] bool usable_after_error() const override { return false; }

  private:
    static int width_of(const display::VideoFormat& format) { return std::min(kThumbnailWidth, format.width); }
    static int height_of(const display::VideoFormat& format) {
        return std::max(1, format.height * width_of(format) / format.width);
    }
    std::filesystem::path file_;
    display::ContactSheet sheet_;
};

}  // namespace

Outlets::Outlets(const Settings& settings) : hashing_(settings.frames && *settings.frames <= kMostHashes) {
    if (hashing_) hashes_.reserve(*settings.frames);
    for (const std::string& url : settings.sinks)
        sinks_.push_back(std::make_unique<display::Sink>(url, settings.format, settings.when_full,
                                                         display::Sink::kDefaultSlots, settings.give_up));
    if (settings.contact_sheet.empty() || !settings.frames) return;
    const std::uint64_t pictures = std::min<std::uint64_t>(kSheetPictures, *settings.frames);
    for (std::uint64_t i = 0; i < pictures; ++i) contact_sheet_frames_.push_back(i * *settings.frames / pictures);
    const int rows = (static_cast<int>(pictures) + kSheetColumns - 1) / kSheetColumns;
    contact_sheet_ = std::make_unique<display::Sink>(
        "contact-sheet:" + settings.contact_sheet.string(),
        std::make_unique<ContactSheetWriter>(settings.contact_sheet, settings.format, rows), settings.format,
        settings.when_full, display::Sink::kDefaultSlots, settings.give_up);
}

void Outlets::hand_over(const FrameImage& image, std::uint64_t number) {
    if (hashing_) hashes_.push_back(display::frame_hash(image));
    for (const auto& sink : sinks_) sink->hand_over(image, number);
    if (next_ < contact_sheet_frames_.size() && number >= contact_sheet_frames_[next_]) {
        contact_sheet_->hand_over(image, number);
        ++next_;
    }
}

bool Outlets::has_error() const {
    const auto broken = [](const std::unique_ptr<display::Sink>& sink) { return sink->has_error(); };
    return std::any_of(sinks_.begin(), sinks_.end(), broken) || (contact_sheet_ && contact_sheet_->has_error());
}

void Outlets::finish(scheduler::FrameReport& report) {
    const auto close = [&](display::Sink& sink) {
        display::SinkStatus status = sink.close();
        report.sinks.push_back(
            {std::move(status.url), status.frames, status.dropped, status.failed, std::move(status.error)});
    };
    for (const auto& sink : sinks_) close(*sink);
    if (contact_sheet_) close(*contact_sheet_);
    if (!hashing_) return;
    report.hash = display::hex(display::sequence_hash(hashes_));
    report.frame_hashes.reserve(hashes_.size());
    for (const std::uint64_t hash : hashes_) report.frame_hashes.push_back(display::hex(hash));
}

}  // namespace quadrig::appliance
