#include "ig_core/objects_in_view.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>
#include <limits>
#include <thread>

#include "ig_core/geometry/fetch.h"

namespace quadrig {
namespace {

constexpr int kSelectBlock = 512;

}  // namespace

void ObjectsInView::select(std::span<const Solid> solids, std::span<const BoundingSphere> spheres,
                           std::span<const std::uint32_t> moved, const View& view, const Quality& quality,
                           Workers& workers) {
    const ImagePlane& image = view.image;
    const int lines = quality.lines_per_row();
    const Sight sight{view.eye,       view.eye_from_scene,
                      image,          {image.top, image.row_step / lines, image.height * lines},
                      quality.set_up, quality.smallest_feature * image.row_step};
    const bool same_view = sight == sight_, same_solids = moved.empty() && solids.size() == may_be_seen_.size();
    sight_ = sight;
    solids_ = solids;
    if (!same_view || !same_solids) {
        find_objects(spheres, view, workers);
        sort_by_depth();
        on_strips_.sort(strips_of(image), selected_.size(),
                        [&](std::size_t place) { return strips_[front_to_back_[place]]; });
    }
    keep_outlines(moved, same_view);
}

void ObjectsInView::find_objects(std::span<const BoundingSphere> spheres, const View& view, Workers& workers) {
    may_be_seen_.resize(solids_.size());
    bounds_.resize(solids_.size());
    strips_.resize(solids_.size());
    const auto walls = walls_of(view);
    const auto task = [&](int block, int) {
        const std::size_t begin = static_cast<std::size_t>(block) * kSelectBlock;
        for (std::size_t i = begin; i < std::min(solids_.size(), begin + kSelectBlock); ++i) {
            may_be_seen_[i] = spheres[i].reaches_into(walls);
            if (may_be_seen_[i] == 0) continue;
            bounds_[i] = image_bounds(solids_[i], view.eye, view.eye_from_scene);
            may_be_seen_[i] = may_show_on(view.image, bounds_[i]);
            strips_[i] = strips_between(view.image, bounds_[i].z_from, bounds_[i].z_to);
        }
    };
    workers.run(static_cast<int>((solids_.size() + kSelectBlock - 1) / kSelectBlock), std::ref(task));
    selected_.clear();
    for (std::uint32_t i = 0; i < may_be_seen_.size(); ++i)
        if (may_be_seen_[i] != 0) selected_.push_back(i);
}

void ObjectsInView::keep_outlines(std::span<const std::uint32_t> moved, bool same_view) {
    if (slots_.size() < solids_.size()) slots_.resize(solids_.size(), kNoSlot);
    if (!same_view) {
        for (const std::uint32_t object : slotted_) slots_[object] = kNoSlot;
        slotted_.clear();
        states_.clear();
    }
    for (const std::uint32_t object : moved)
        if (slots_[object] != kNoSlot) states_[slots_[object]] = OutlineState::none;
    for (const std::uint32_t object : selected_) {
        if (slots_[object] != kNoSlot) continue;
        slots_[object] = static_cast<std::uint32_t>(slotted_.size());
        slotted_.push_back(object);
    }
    states_.resize(slotted_.size(), OutlineState::none);
    if (outlines_.size() < slotted_.size()) outlines_.resize(slotted_.size());
    kept_ = 0;
    kept_ = outlines_made();
}

void ObjectsInView::sort_by_depth() {
    // Roughly is enough, and counting by the leading bits of a float takes a tenth of a sort's time.
    const auto bin_of = [&](std::uint32_t object) {
        const auto nearest = static_cast<float>(std::max(bounds_[object].nearest, 0.0));
        return std::bit_cast<std::uint32_t>(nearest) >> 18;  // five bits of mantissa
    };
    constexpr auto kLastBin = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()) >> 18;
    depth_bins_.assign(kLastBin + 2, 0);
    for (const std::uint32_t object : selected_) ++depth_bins_[bin_of(object) + 1];
    for (std::size_t bin = 1; bin < depth_bins_.size(); ++bin) depth_bins_[bin] += depth_bins_[bin - 1];
    front_to_back_.resize(selected_.size());
    for (const std::uint32_t object : selected_) front_to_back_[depth_bins_[bin_of(object)]++] = object;
}

std::size_t ObjectsInView::outlines_made() const {
    return static_cast<std::size_t>(std::count(states_.begin(), states_.end(), OutlineState::made)) - kept_;
}

const Outline& ObjectsInView::outline(std::uint32_t place, std::chrono::nanoseconds& time) {
    const std::uint32_t index = object(place), slot = slots_[index];
    Outline& outline = outlines_[slot];
    const std::atomic_ref state(states_[slot]);
    OutlineState seen = state.load(std::memory_order_acquire);
    if (seen == OutlineState::made) return outline;  // on all rows but the first: nothing is locked then
    fetch(solids_[index]), fetch(outline);
    if (seen == OutlineState::none &&
        state.compare_exchange_strong(seen, OutlineState::begun, std::memory_order_acquire)) {
        const auto start = std::chrono::steady_clock::now();
        const Sight& s = sight_;
        make_outline(solids_[index], bounds_[index], index, s.eye, s.eye_from_scene, s.rows, outline, s.set_up);
        if (outline.zeta_to - outline.zeta_from < s.least_height) outline.zeta_from = 1.0, outline.zeta_to = -1.0;
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
