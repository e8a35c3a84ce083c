#include "ig_core/objects_in_view.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>
#include <thread>
#include <utility>

#include "ig_core/geometry/fetch.h"

namespace quadrig {
namespace {

/// A worker selects among so many objects at a time.
constexpr std::size_t kBlock = 512;
static_assert(kBlock % SolidExtents::kSolids == 0);

}  // namespace

void ObjectsInView::select(std::span<const Solid> solids, std::span<const SolidExtents> extents,
                           std::span<const std::uint32_t> moved, const View& view, const Quality& quality,
                           Workers& workers) {
    const ImagePlane& image = view.image;
    const int lines = quality.lines_per_row();
    const Sight sight{view.eye,       view.eye_from_scene,
                      image,          {image.top, image.row_step / lines, image.height * lines},
                      quality.set_up, quality.smallest_feature * image.row_step};
    const bool same_view = sight == sight_, same_solids = moved.empty() && solids.size() == solids_.size();
    sight_ = sight;
    solids_ = solids;
    if (!same_view || !same_solids) {
        find_objects(extents, view, workers);
        sort_by_depth();
        on_strips_.sort(strips_of(image), in_view_.size(), [&](std::size_t place) {
            return std::pair<int, int>(in_view_[place].first_strip, in_view_[place].last_strip);
        });
    }
    keep_outlines(moved, same_view);
}

void ObjectsInView::find_objects(std::span<const SolidExtents> extents, const View& view, Workers& workers) {
    const std::size_t blocks = (solids_.size() + kBlock - 1) / kBlock;
    found_.resize(blocks * kBlock);
    found_count_.resize(blocks);
    const auto task = [&](int block, int) {
        constexpr std::size_t kExtents = kBlock / SolidExtents::kSolids;
        const auto b = static_cast<std::size_t>(block);
        const auto of_block = extents.subspan(b * kExtents, std::min(kExtents, extents.size() - b * kExtents));
        const std::size_t first = b * kBlock;
        found_count_[b] = quadrig::select(of_block, static_cast<std::uint32_t>(first), view, &found_[first]);
    };
    workers.run(static_cast<int>(blocks), std::ref(task));
}

void ObjectsInView::keep_outlines(std::span<const std::uint32_t> moved, bool same_view) {
    if (slots_.size() < solids_.size()) slots_.resize(solids_.size(), InView::kNoSlot);
    if (!same_view) {
        for (const std::uint32_t object : slotted_) slots_[object] = InView::kNoSlot;
        slotted_.clear();
        states_.clear();
    }
    for (const std::uint32_t object : moved)
        if (slots_[object] != InView::kNoSlot) states_[slots_[object]] = OutlineState::none;
    for (InView& seen : in_view_) {
        std::uint32_t& slot = slots_[seen.object];
        if (slot == InView::kNoSlot) {
            slot = static_cast<std::uint32_t>(slotted_.size());
            slotted_.push_back(seen.object);
        }
        seen.slot = slot;
    }
    states_.resize(slotted_.size(), OutlineState::none);
    if (outlines_.size() < slotted_.size()) outlines_.resize(slotted_.size());
    kept_ = 0;
    kept_ = outlines_made();
}

void ObjectsInView::sort_by_depth() {
    // Roughly is enough, and counting by the leading bits of a float takes a tenth of a sort's time.
    const auto bin_of = [&](const InView& seen) {
        const auto nearest = static_cast<float>(std::max(seen.bounds.nearest, 0.0));
        return std::bit_cast<std::uint32_t>(nearest) >> 18;  // five bits of mantissa
    };
    const auto for_each_found = [&](auto&& look_at) {
        for (std::size_t block = 0; block < found_count_.size(); ++block)
            for (const InView& seen : std::span(found_).subspan(block * kBlock, found_count_[block])) look_at(seen);
    };
    constexpr auto kLastBin = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()) >> 18;
    depth_bins_.assign(kLastBin + 2, 0);
    for_each_found([&](const InView& seen) { ++depth_bins_[bin_of(seen) + 1]; });
    for (std::size_t bin = 1; bin < depth_bins_.size(); ++bin) depth_bins_[bin] += depth_bins_[bin - 1];
    in_view_.resize(depth_bins_.back());
    for_each_found([&](const InView& seen) { in_view_[depth_bins_[bin_of(seen)]++] = seen; });
}

std::size_t ObjectsInView::outlines_made() const {
    return static_cast<std::size_t>(std::count(states_.begin(), states_.end(), OutlineState::made)) - kept_;
}

const Outline& ObjectsInView::outline(std::uint32_t place, std::chrono::nanoseconds& time) {
    const std::uint32_t index = in_view_[place].object, slot = in_view_[place].slot;
    Outline& outline = outlines_[slot];
    const std::atomic_ref state(states_[slot]);
    OutlineState seen = state.load(std::memory_order_acquire);
    if (seen == OutlineState::made) return outline;  // on all rows but the first: nothing is locked then
    fetch(solids_[index]), fetch(outline);
    if (seen == OutlineState::none &&
        state.compare_exchange_strong(seen, OutlineState::begun, std::memory_order_acquire)) {
        const auto start = std::chrono::steady_clock::now();
        const Sight& s = sight_;
        make_outline(solids_[index], in_view_[place].bounds, index, s.eye, s.eye_from_scene, s.rows, outline, s.set_up);
        if (outline.zeta_to - outline.zeta_from < s.least_height) outline.show_on_no_row();
        state.store(OutlineState::made, std::memory_order_release);
        time += std::chrono::steady_clock::now() - start;
        return outline;
    }
    // Another worker is at it, for some microseconds: the frame is not finished before it is, either.
    while (seen != OutlineState::made) {
        std::this_thread::yield();
        seen = state.load(std::memory_order_acquire);
    }
    return outline;
}

}  // namespace quadrig
