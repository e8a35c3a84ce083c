#include "host_link/frame_order.h"

#include <algorithm>

namespace quadrig::host {

void FrameOrder::start(std::uint32_t frame, std::uint64_t fingerprint, Time arrival) {
    seen_.fill(std::nullopt);
    seen_[frame % kWindow] = fingerprint;
    newest_ = frame;
    newest_arrival_ = arrival;
    since_start_ = 0;
}

Arrival FrameOrder::arrive(std::uint32_t frame, std::uint64_t fingerprint, Time arrival) {
    if (!newest_) {
        start(frame, fingerprint, arrival);
        return Arrival::next;
    }
    const std::uint32_t ahead = frame - *newest_;
    if (ahead != 0 && ahead < kFarAhead) {
        for (std::uint32_t skipped = 1; skipped < std::min(ahead, kWindow); ++skipped)
            seen_[(*newest_ + skipped) % kWindow].reset();
        seen_[frame % kWindow] = fingerprint;
        newest_ = frame;
        newest_arrival_ = arrival;
        lost_ += ahead - 1;
        since_start_ = std::min(since_start_ + ahead, kWindow);
        return Arrival::next;
    }
    const std::uint32_t behind = *newest_ - frame;
    if (behind >= kWindow || arrival - newest_arrival_ >= kLate) {
        start(frame, fingerprint, arrival);
        return Arrival::restart;
    }
    std::optional<std::uint64_t>& seen = seen_[frame % kWindow];
    if (seen == fingerprint) return Arrival::duplicate;
    if (seen) {
        start(frame, fingerprint, arrival);
        return Arrival::restart;
    }
    // What comes before the first message of a count was never missed.
    if (behind < since_start_) --lost_;
    seen = fingerprint;
    return Arrival::late;
}

}  // namespace quadrig::host
