/// From visible runs to pixels: each surface is shaded once per pixel it shows in, then layers are laid over one
/// another.
#pragma once

#include <array>
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

/// Shades the samples of some rows together, and composites these one by one; keeps its memory from row to row.
class RowShader {
  public:
    /// Adds a row to those that are drawn next, unless is_full(). It has to live until then, and so has its sweep.
    void add(const PixelRow& row, const RowSweep& sweep);
    /// Whether these are so many that more of them would gain nothing, and not stay in the cache.
    [[nodiscard]] bool is_full() const;
    /// Draws them in linear light. After each, `write(row)` may ask for it by what follows.
    template <class Write>
    void draw(const FrameShading& frame, Write&& write) {
        if (added_count_ > 0) shade_samples(frame);
        for (const AddedRow& row : std::span(added_).first(added_count_)) {
            composite(frame, row);
            write(*row.pixels);
        }
        added_count_ = layer_count_ = sample_count_ = job_count_ = 0;
    }
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
    struct AddedRow {
        const PixelRow* pixels = nullptr;
        const RowSweep* sweep = nullptr;
        std::vector<std::uint32_t> job_of_layer;  // parallel to RowSweep::layers
    };
    /// Which columns of each span of a row are shaded.
    void plan(AddedRow& row);
    /// Puts jobs that are shaded alike one behind the other.
    void order_jobs(const FrameShading& frame);
    void shade_samples(const FrameShading& frame);
    /// Tells of the row's runs how their samples are laid over one another.
    void lay_out(const FrameShading& frame, const AddedRow& row);
    void composite(const FrameShading& frame, const AddedRow& row);

    static constexpr std::size_t kMostRows = 8;
    std::array<AddedRow, kMostRows> added_;
    std::size_t added_count_ = 0, layer_count_ = 0, sample_count_ = 0;  // of these rows
    std::vector<ShadeJob> jobs_;                                        // the first job_count_ of them
    std::size_t job_count_ = 0;
    std::vector<std::uint32_t> order_;
    std::vector<ShadeInput> inputs_;
    /// The last job of a span, and the column from which on another is better: one number, which a processor has back
    /// sooner than two.
    using LastJob = std::uint64_t;
    std::vector<LastJob> last_of_span_;
    std::vector<CompositeLayer> layers_;  // of the row that is composited, parallel to RowSweep::layers
    std::vector<CompositeRun> packed_;    // those of its whole runs that are packed straight from their samples
    std::vector<CompositeRun> whole_, before_whole_, partial_;
    ShadeBuffer buffer_, row_, upper_;
    Work work_;
};

}  // namespace quadrig
