/// The objects of one frame: which may be in view, from front to back, on which strips, and the outlines of those that
/// turn out to be seen.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "ig_core/outline/outline.h"
#include "ig_core/select.h"
#include "ig_core/strip_index.h"
#include "ig_core/workers.h"

namespace quadrig {

class ObjectsInView {
  public:
    /// Begins a frame: selects among the solids by their extents. The solids have to stay as they are until the next
    /// frame begins; `moved` has the indices of those that are not as they were in the last one, the new ones too. As
    /// long as eye, image and quality stay the same, the others keep their outlines.
    void select(std::span<const Solid> solids, std::span<const SolidExtents> extents,
                std::span<const std::uint32_t> moved, const View& view, const Quality& quality, Workers& workers);

    [[nodiscard]] std::size_t count() const { return in_view_.size(); }
    /// How many outlines have been made since the frame began.
    [[nodiscard]] std::size_t outlines_made() const;

    /// Places, front to back, of the objects that may show on a strip.
    [[nodiscard]] std::span<const std::uint32_t> on(int strip) const { return on_strips_.on(strip); }
    [[nodiscard]] std::uint32_t object(std::uint32_t place) const { return in_view_[place].object; }
    [[nodiscard]] const ImageBounds& bounds(std::uint32_t place) const { return in_view_[place].bounds; }

    /// The outline of the object at a place. Whichever worker asks first makes it, and adds to `time` how long that
    /// took.
    const Outline& outline(std::uint32_t place, std::chrono::nanoseconds& time);

  private:
    void find_objects(std::span<const SolidExtents> extents, const View& view, Workers& workers);
    void sort_by_depth();
    /// Gives every object in view a slot, and empties the slots of what moved.
    void keep_outlines(std::span<const std::uint32_t> moved, bool same_view);

    /// What all outlines depend on.
    struct Sight {
        ScenePoint eye;
        glm::dmat3 eye_from_scene{0.0};
        ImagePlane image;
        RowGrid rows;
        SetUp set_up = SetUp::anchored;
        double least_height = 0.0;  ///< image plane; what is lower is left out
        friend bool operator==(const Sight&, const Sight&) = default;
    };

    std::span<const Solid> solids_;
    std::vector<InView> found_;             // block by block, each with room for all its objects
    std::vector<std::size_t> found_count_;  // by block
    std::vector<std::uint32_t> depth_bins_;
    std::vector<InView> in_view_;  // by place: front to back
    StripIndex on_strips_;

    enum class OutlineState : std::uint8_t { none, begun, made };
    std::vector<std::uint32_t> slots_;    // by object
    std::vector<std::uint32_t> slotted_;  // objects, by slot
    std::vector<OutlineState> states_;    // by slot
    std::vector<Outline> outlines_;       // by slot; they only ever grow in number, to keep their memory
    std::size_t kept_ = 0;                // outlines from frames before
    Sight sight_;
};

}  // namespace quadrig
