#include "ig_core/shading/row_shader.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "ig_core/geometry/fetch.h"
#include "ig_core/spans/depth_on_line.h"

namespace quadrig {
namespace {

/// A surface hidden for no more columns than this is shaded on through: a new vector costs more.
constexpr int kLongestIdleRun = 12;

/// Rows are shaded together until they have so many layers or samples: few jobs leave vectors unfilled, and what many
/// write does not stay in the cache.
constexpr std::size_t kManyLayers = 256, kManySamples = 32768;

/// A whole run of so many columns is packed straight from its samples: shorter ones do not fill a vector.
constexpr int kLongRun = 16;

/// Where a span is sampled: on the mean of its sub-scan lines, between the means of their ends, which a convex outline
/// has inside it; but no farther in than half a column from its outermost end, where edges are nearly level.
struct SampleRange {
    double z = 0.0, from = 0.0, to = 0.0;
};
SampleRange sample_range(const PixelRow& row, const RowSpan& span) {
    constexpr double kFarthestIn = 0.5;
    SampleRange mean;
    double outer_from = std::numeric_limits<double>::infinity(), outer_to = -outer_from;
    int lines = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i) {
        if (!(span.from[i] < span.to[i])) continue;
        mean.z += row.z[i], mean.from += span.from[i], mean.to += span.to[i];
        outer_from = std::min(outer_from, span.from[i]), outer_to = std::max(outer_to, span.to[i]);
        ++lines;
    }
    const double share = 1.0 / std::max(1, lines);
    return {share * mean.z, std::min(share * mean.from, outer_from + kFarthestIn),
            std::max(share * mean.to, outer_to - kFarthestIn)};
}

/// Whether neither span hides any of the other: faces of one object, and objects that abut.
bool side_by_side(const PixelRow& row, const RowSpan& a, const RowSpan& b) {
    constexpr double kRounding = 1e-6;  // columns
    double most = 0.0;                  // of any sub-scan line that both cover
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.sub_lines); ++i)
        most = std::max(most, std::min(a.to[i], b.to[i]) - std::max(a.from[i], b.from[i]));
    return (most <= kRounding) | ((a.surface.outline != nullptr) & (a.surface.outline == b.surface.outline));
}

/// Whether layers of a run of edge pixels lie side by side in front of one that is opaque and covers all of every
/// pixel: so do most.
bool side_by_side_before_whole(const PixelRow& row, const LayerRun& run, std::span<const CompositeLayer> layers) {
    const RowSpan& last = *layers.back().span;
    if (!(last.surface.opaque & (last.inner_from <= run.from) & (last.inner_to >= run.to))) return false;
    for (std::size_t i = 1; i + 1 < layers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!side_by_side(row, *layers[i].span, *layers[j].span)) return false;
    return true;
}

/// Puts layers that lie side by side in one group, one behind the other.
void group(const PixelRow& row, std::span<CompositeLayer> layers) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        CompositeLayer layer = layers[i];
        // Beside all layers from some group on: it changes nothing to draw it with that group.
        std::size_t place = i;
        layer.group = static_cast<std::uint32_t>(i);
        for (std::size_t j = i; j-- > 0 && side_by_side(row, *layer.span, *layers[j].span);)
            if (j == 0 || layers[j - 1].group != layers[j].group) layer.group = layers[j].group, place = j;
        while (place < i && layers[place].group == layer.group) ++place;
        const std::span<CompositeLayer> moved = layers.subspan(place, i + 1 - place);
        std::shift_right(moved.begin(), moved.end(), 1);
        moved[0] = layer;
    }
}

/// `x` is that of the job's first column, `half_width` half of what its columns span. The polynomials are about the
/// middle one: where a needle or an edge lies far from its anchor's image, L about that would be what single precision
/// leaves of a difference.
void set_quadric(const EyeSolid& e, double x, double z, double half_width, ShadeInput& in) {
    const double zeta = z - e.z0, middle = x - e.x0 + half_width;
    in.kind = ShadeInput::Kind::quadric;
    in.xi = static_cast<float>(-half_width);
    in.c = static_cast<float>(e.s);
    in.b = {static_cast<float>(e.v.y + e.v.z * zeta + e.v.x * middle), static_cast<float>(e.v.x)};
    const auto on_row = [&](const Sym3& form) {
        const double constant = form.yy + zeta * (2.0 * form.yz + zeta * form.zz);
        const double linear = 2.0 * (form.xy + form.xz * zeta);
        return std::array<float, 3>{static_cast<float>(constant + middle * (linear + middle * form.xx)),
                                    static_cast<float>(linear + 2.0 * middle * form.xx), static_cast<float>(form.xx)};
    };
    in.a = on_row(e.m);
    in.limb = on_row(e.limb);
    in.quadric = &e.in_scene;
}

/// `depth` is that of the job's first sample.
void set_plane(const std::array<float, 3>& outward, const DepthSample<double>& depth, ShadeInput& in) {
    in.kind = ShadeInput::Kind::plane;
    in.normal = outward;
    in.plane_u = static_cast<float>(depth.u);
    in.plane_u_step = static_cast<float>(depth.slope);
}

/// Colour of a light's disc: what the haze lets through of it, no more than the picture can hold, over the haze's own.
std::array<float, 3> seen_light(const LightPoint& light, const SeenLight& seen, const FrameLight& frame) {
    const double range = std::sqrt(1.0 + seen.x * seen.x + seen.z * seen.z) / seen.u;
    const double kept = frame.haze ? std::exp2(-range * frame.extinction) : 1.0;
    const glm::dvec3 haze = (1.0 - kept) * glm::dvec3(frame.haze_colour[0], frame.haze_colour[1], frame.haze_colour[2]);
    const auto most = [](const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); };
    const double room = std::max(0.0, 1.0 - most(haze)) / std::max(most(light.colour), 1e-9);
    return to_float(haze + std::min(kept * light.intensity, room) * light.colour);
}

ShadeRow shade_row(const FrameShading& frame, const PixelRow& row) {
    return {&frame.light,
            frame.quality.smooth_stretches,
            shades_pairs(frame.quality.shading),
            to_float(frame.scene_from_eye[0] * row.column_step),
            to_float(frame.scene_from_eye[2] * row.row_step),
            static_cast<float>(row.column_step)};
}

/// What a surface is painted with: null for the sky and for lights.
const FramePaint* paint_of(const FramePaints& paints, const Surface& surface) {
    switch (surface.kind) {
        case Surface::Kind::quadric:
        case Surface::Kind::face:
            return &paints.objects[surface.index];
        case Surface::Kind::marking:
            return &paints.markings[surface.index];
        case Surface::Kind::ground:
            return &paints.ground;
        case Surface::Kind::deck:
            return &paints.decks[surface.index];
        default:
            return nullptr;
    }
}

/// Jobs are put in order by bins, the sky and lights first. What is asked of jobs of one bin is the same, so that they
/// are shaded together and a processor foresees the next one's way.
constexpr std::size_t kBins = 1 + 4 * kPaintBins;
std::uint8_t bin_of(const Surface& surface, const ShadeJob& job) {
    if (job.paint == nullptr) return 0;
    const bool quadric = surface.kind == Surface::Kind::quadric, few = job.to - job.from <= kFewSamples;
    return static_cast<std::uint8_t>(1 + 4 * job.paint->bin + 2 * few + quadric);
}

/// What set_job() asks of a surface's outline, which lies anywhere.
void fetch_outline(const Surface& surface) {
    if (surface.kind == Surface::Kind::face) {
        fetch(surface.outline->solid.face(surface.surface));
    } else if (surface.kind == Surface::Kind::quadric) {
        const EyeSolid& solid = surface.outline->solid;
        fetch(solid.x0), fetch(solid.m), fetch(solid.limb), fetch(solid.in_scene);
    }
}

/// The numbers of one job on its row. Those that its kind of surface has no use for are left as they are.
void set_job(const FrameShading& frame, const PixelRow& row, const ShadeJob& job, ShadeInput& in) {
    const SampleRange range = sample_range(row, *job.span);
    const Surface& surface = job.span->surface;
    in.count = job.to - job.from;
    in.buffer = job.buffer;
    in.paint = job.paint;
    const double first = job.from + 0.5, x = row.x(first);
    in.least_column = static_cast<float>(range.from - first);
    in.most_column = static_cast<float>(range.to - first);
    in.ray = to_float(frame.scene_from_eye * glm::dvec3(x, 1.0, range.z));
    constexpr std::array<float, 3> kUp{0, 0, 1};
    const auto depth = [&] { return DepthOnLine(surface, row, range.z).at(first); };
    switch (surface.kind) {
        case Surface::Kind::sky:
            in.kind = ShadeInput::Kind::sky;
            break;
        case Surface::Kind::light:
            in.kind = ShadeInput::Kind::light;
            in.colour = seen_light((*frame.lights)[surface.index], *surface.light, frame.light);
            break;
        case Surface::Kind::quadric:
            set_quadric(surface.outline->solid, x, range.z, 0.5 * (in.count - 1) * row.column_step, in);
            break;
        case Surface::Kind::face:
            set_plane(surface.outline->solid.face(surface.surface).scene_outward, depth(), in);
            break;
        case Surface::Kind::marking:
        case Surface::Kind::ground:
        case Surface::Kind::deck:
            set_plane(kUp, depth(), in);
            break;
    }
}

}  // namespace

#ifndef NDEBUG
namespace {
/// Whether nothing is infinite or NaN from one place to another.
bool all_numbers(const ShadeBuffer& light, int from, int to) {
    const auto finite = [&](const std::vector<float>& plane) {
        return std::all_of(plane.begin() + from, plane.begin() + to, [](float x) { return std::isfinite(x); });
    };
    return finite(light.red) && finite(light.green) && finite(light.blue);
}
bool all_numbers(const ShadeBuffer& row, const std::vector<CompositeRun>& runs) {
    return std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return all_numbers(row, run.from, run.to); });
}
}  // namespace
#endif

void RowShader::add(const PixelRow& row, const RowSweep& sweep) {
    AddedRow& added = added_[added_count_++];
    added.pixels = &row, added.sweep = &sweep;
    plan(added);
}

bool RowShader::is_full() const {
    return added_count_ == kMostRows || layer_count_ >= kManyLayers || sample_count_ >= kManySamples;
}

void RowShader::plan(AddedRow& row) {
    const RowSweep& sweep = *row.sweep;
    const auto row_index = static_cast<std::uint8_t>(&row - added_.data());
    last_of_span_.assign(sweep.spans.size(), 0);
    row.job_of_layer.resize(sweep.layers.size());
    if (jobs_.size() <= job_count_ + sweep.layers.size()) jobs_.resize(job_count_ + sweep.layers.size() + 1);
    auto count = static_cast<std::uint32_t>(job_count_);
    for (const LayerRun& run : sweep.runs) {
        const int from = run.from, to = run.to;
        const std::uint32_t last_layer = run.first_layer + run.layer_count;
        for (std::uint32_t i = run.first_layer; i < last_layer; ++i) {
            const std::uint32_t span = sweep.layers[i];
            const LastJob last = last_of_span_[span];
            // Nothing could foresee whether a job begins here, so no branch: the next one is written down in any case.
            const bool begins = from >= static_cast<int>(last >> 32);
            const std::uint32_t job = begins ? count : static_cast<std::uint32_t>(last);
            jobs_[count].span = &sweep.spans[span], jobs_[count].from = from, jobs_[count].row = row_index;
            jobs_[job].to = to;
            last_of_span_[span] = static_cast<LastJob>(to + kLongestIdleRun + 1) << 32 | job;
            row.job_of_layer[i] = job;
            count += begins ? 1 : 0;
        }
        sample_count_ += static_cast<std::size_t>(to - from) * run.layer_count;
    }
    layer_count_ += sweep.layers.size();
    job_count_ = count;
}

void RowShader::order_jobs(const FrameShading& frame) {
    std::array<std::uint32_t, kBins + 1> first_in_bin{};
    const std::span<ShadeJob> jobs = std::span(jobs_).first(job_count_);
    for (ShadeJob& job : jobs) {
        const Surface& surface = job.span->surface;
        job.paint = paint_of(*frame.paints, surface);
        job.bin = bin_of(surface, job);
        ++first_in_bin[job.bin + 1U];
    }
    for (std::size_t i = 1; i < first_in_bin.size(); ++i) first_in_bin[i] += first_in_bin[i - 1];
    order_.resize(jobs.size());
    for (std::uint32_t i = 0; i < job_count_; ++i) order_[first_in_bin[jobs_[i].bin]++] = i;
}

void RowShader::shade_samples(const FrameShading& frame) {
    order_jobs(frame);
    std::uint32_t samples = 0;
    const ShadeRow common = shade_row(frame, *added_[0].pixels);
    inputs_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
        constexpr std::size_t kTurnsAhead = 8;
        fetch_outline(jobs_[order_[std::min(i + kTurnsAhead, order_.size() - 1)]].span->surface);
        ShadeJob& job = jobs_[order_[i]];
        job.buffer = samples;
        samples += static_cast<std::uint32_t>(job.to - job.from);
        set_job(frame, *added_[job.row].pixels, job, inputs_[i]);
        inputs_[i].row = &common;
    }
    buffer_.resize(samples + kShadePadding);
    work_.stretches += order_.size();
    work_.samples += samples;
    work_.terms += shade(inputs_, buffer_);
    assert(all_numbers(buffer_, 0, static_cast<int>(samples)));
}

void RowShader::lay_out(const FrameShading& frame, const AddedRow& row) {
    const RowSweep& sweep = *row.sweep;
    layers_.resize(sweep.layers.size());
    for (std::size_t i = 0; i < layers_.size(); ++i) {
        const ShadeJob& job = jobs_[row.job_of_layer[i]];
        layers_[i] = {job.buffer - static_cast<std::uint32_t>(job.from), 0, job.span};
    }
    packed_.clear(), whole_.clear(), before_whole_.clear(), partial_.clear();
    const bool samples_are_pixels = pixels_across(frame.quality.shading) == 1.0;
    for (const LayerRun& run : sweep.runs) {
        const std::span<CompositeLayer> layers = std::span(layers_).subspan(run.first_layer, run.layer_count);
        const CompositeRun laid_out{run.from, run.to, layers};
        if (!run.partial) {
            (samples_are_pixels && run.to - run.from >= kLongRun ? packed_ : whole_).push_back(laid_out);
            continue;
        }
        work_.edge_pixels += static_cast<std::uint64_t>(run.to - run.from);
        if (side_by_side_before_whole(*row.pixels, run, layers)) {
            before_whole_.push_back(laid_out);
        } else {
            group(*row.pixels, layers);
            partial_.push_back(laid_out);
        }
    }
}

void RowShader::composite(const FrameShading& frame, const AddedRow& row) {
    const PixelRow& pixels = *row.pixels;
    lay_out(frame, row);
    row_.resize(static_cast<std::size_t>(pixels.columns) + kShadePadding);
    composite_whole(buffer_, whole_, row_);
    composite_before_whole(buffer_, before_whole_, pixels.sub_lines, row_);
    composite_partial(buffer_, partial_, pixels.sub_lines, row_);
    assert(all_numbers(row_, whole_) && all_numbers(row_, before_whole_) && all_numbers(row_, partial_));
}

void RowShader::write(int columns, std::uint8_t* rgba) const { pack_srgb8(buffer_, packed_, row_, columns, rgba); }

void RowShader::write_doubled(int columns, std::uint8_t* upper, std::uint8_t* lower) const {
    pack_srgb8_doubled(row_, columns, upper, lower);
}

void RowShader::keep_upper() { std::swap(row_, upper_); }

void RowShader::write_averaged(int columns, std::uint8_t* rgba) {
    average_squares(upper_, columns, row_);
    pack_srgb8(row_, columns, rgba);
}

}  // namespace quadrig
