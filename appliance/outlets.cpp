#include "appliance/outlets.h"

#include <algorithm>
#include <utility>

#include "display/contact_sheet_sink.h"
#include "display/frame_hash.h"

namespace quadrig::appliance {

Outlets::Outlets(const Settings& settings) : hashing_(settings.frames && *settings.frames <= kMostHashes) {
    if (hashing_) hashes_.reserve(*settings.frames);
    for (const std::string& url : settings.sinks)
        sinks_.push_back(std::make_unique<display::Sink>(url, settings.format, settings.when_full,
                                                         display::Sink::kDefaultSlots, settings.give_up));
    if (settings.contact_sheet.empty()) return;
    sinks_.push_back(std::make_unique<display::Sink>(
        "contact-sheet:" + settings.contact_sheet.string(),
        std::make_unique<display::ContactSheetWriter>(settings.contact_sheet, settings.format), settings.format,
        settings.when_full, display::Sink::kDefaultSlots, settings.give_up));
}

void Outlets::hand_over(const FrameImage& image, std::uint64_t number) {
    if (hashing_) hashes_.push_back(display::frame_hash(image));
    for (const auto& sink : sinks_) sink->hand_over(image, number);
}

bool Outlets::has_error() const {
    return std::any_of(sinks_.begin(), sinks_.end(), [](const auto& sink) { return sink->has_error(); });
}

void Outlets::finish(scheduler::FrameReport& report) {
    for (const auto& sink : sinks_) {
        display::SinkStatus status = sink->close();
        report.sinks.push_back(
            {std::move(status.url), status.frames, status.dropped, status.failed, std::move(status.error)});
    }
    if (!hashing_) return;
    report.hash = display::hex(display::sequence_hash(hashes_));
    report.frame_hashes.reserve(hashes_.size());
    for (const std::uint64_t hash : hashes_) report.frame_hashes.push_back(display::hex(hash));
}

}  // namespace quadrig::appliance
