/// From visible runs to pixels: each surface is shaded once per pixel it shows in, then layers are laid over one
/// another.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "ig_core/shading/compositing.h"
#include "ig_core/shading/frame_paint.h"
#include "ig_core/shading/shade.h"
#include "ig_core/spans/sweep.h"

namespace quadrig {

/// What is common to all rows of a frame. Spans lead into it by Surface::outline and Surface::index.
struct FrameShading {
    glm::dmat3 scene_from_eye{1.0};
    const FramePaints* paints = nullptr;
    const std::vector<LightPoint>* lights = nullptr;  ///< the scene's
    FrameLight light;
    Quality quality;
};

/// Shades and composites one row at a time; keeps its memory from row to row.
class RowShader {
  public:
    /// Draws one row in linear light.
    void draw(const FrameShading& frame, const PixelRow& row, const RowSweep& sweep);
    /// The row drawn last, as 8-bit sRGB.
    void write(int columns, std::uint8_t* rgba) const;
    /// The row drawn last, as 8-bit sRGB of twice as many columns, into one or two rows of a picture; `lower` may be
    /// null.
    void write_doubled(int columns, std::uint8_t* upper, std::uint8_t* lower) const;
    /// Keeps the row drawn last as the upper of two, and averages those two over squares of 2 x 2 columns, as 8-bit
    /// sRGB of half as many columns.
    void keep_upper();
    void write_averaged(int columns, std::uint8_t* rgba);

    /// What was done since it was asked last.
    struct Work {
        std::uint64_t stretches = 0, samples = 0, terms = 0, edge_pixels = 0;
    };
    Work take_work() { return std::exchange(work_, {}); }

  private:
    /// Which columns of each span are shaded.
    void plan(const RowSweep& sweep);
    /// Puts jobs that are shaded alike one behind the other in the buffer.
    void order_jobs(const FrameShading& frame, const RowSweep& sweep);
    /// Tells of the row's runs how their samples are laid over one another.
    void lay_out(const PixelRow& row, const RowSweep& sweep);

    std::vector<ShadeJob> jobs_;  // the first job_count_ of them
    std::uint32_t job_count_ = 0;
    std::vector<std::uint32_t> order_;
    std::vector<ShadeInput> inputs_;
    /// The last job of a span, and the column from which on another is better: one number, which a processor has back
    /// sooner than two.
    using LastJob = std::uint64_t;
    std::vector<LastJob> last_of_span_;
    std::vector<std::uint32_t> job_of_layer_;  // parallel to RowSweep::layers
    std::vector<CompositeLayer> layers_;       // the same
    std::vector<CompositeRun> whole_, before_whole_, partial_;
    ShadeBuffer buffer_, row_, upper_;
    Work work_;
};

}  // namespace quadrig
