#include "ig_core/image_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "ig_core/geometry/fetch.h"
#include "ig_core/objects_in_view.h"
#include "ig_core/scene/motion.h"
#include "ig_core/shading/row_shader.h"
#include "ig_core/spans/depth_on_line.h"
#include "ig_core/spans/object_spans.h"
#include "ig_core/spans/row_spans.h"
#include "ig_core/spans/seen_features.h"
#include "ig_core/spans/strip_cover.h"
#include "ig_core/strip_index.h"
#include "ig_core/workers.h"

namespace quadrig {
namespace {

using Clock = std::chrono::steady_clock;

/// 1/k of the plane Z = altitude over the image: P(k d) = height + k n.d (Eq 7).
PlaneDepth horizontal_plane(const View& view, double altitude) {
    const double height = view.eye.metres.z - altitude;
    const glm::dvec3 up = view.eye_from_scene[2];
    if (height == 0.0) return {};  // edge-on: nowhere in front
    return {-up.y / height, -up.x / height, -up.z / height};
}

/// Scratch of one worker; nothing in it survives a strip but its memory.
struct RowWorker {
    ObjectSpans object;
    StripCover cover;
    std::array<RowSweep, kStripRows> sweeps;  // of a strip's rows
    RowSweeper sweeper;
    RowShader shader;
    std::chrono::nanoseconds outline_time{0}, sweep_time{0}, draw_time{0};
    std::uint64_t span_count = 0, pair_count = 0;
};

/// Rows, a bit each, that lie within the bounds of something.
StripCover::Rows rows_within(std::span<const PixelRow> rows, const ImageBounds& around) {
    StripCover::Rows within = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const PixelRow& row = rows[r];
        const bool is_within =
            row.z[0] >= around.z_from && row.z[static_cast<std::size_t>(row.sub_lines) - 1] <= around.z_to;
        within |= static_cast<StripCover::Rows>(is_within) << r;
    }
    return within;
}

}  // namespace

struct ImageGenerator::Impl {
    Impl(Scene s, int threads) : scene(std::move(s)), workers(threads), row_workers(static_cast<std::size_t>(threads)) {
        solids.reserve(scene.objects.size());
        for (const Object& object : scene.objects) solids.push_back(make_solid(object));
        for (std::size_t i = 0; i < solids.size(); ++i) set_extent(i);
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
            if (scene.objects[i].motion) moving.push_back({i, solids[i]});
        for (const Model& model : scene.models) {
            std::vector<Solid>& at_rest = models.emplace_back();
            for (const Object& object : model.objects) at_rest.push_back(make_solid(object));
        }
        paints = make_frame_paints(scene);
        for (const FramePaint& paint : paints.objects) object_opaque.push_back(!paint.translucent);
        for (const FramePaint& deck : paints.decks) deck_opaque.push_back(!deck.translucent);
    }

    /// Notes where a solid now is.
    void set_extent(std::size_t solid) {
        const std::size_t lanes = solid / SolidExtents::kSolids;
        if (extents.size() <= lanes) extents.resize(lanes + 1);
        extents[lanes].set(solid % SolidExtents::kSolids, solids[solid]);
    }
    /// Puts what moves where it is: objects by scene time, models by the host.
    void move_objects(const Environment& environment);

    /// Ground, decks, markings and lights.
    void look_at_features(const View& view, const Environment& environment, double pixel_height);
    void look_at_decks(const View& view, const Environment& environment);
    /// Spans of a strip's rows, object by object: each is looked up once.
    void add_spans(std::span<const PixelRow> rows, bool everything_opaque, const PlaneSurfaces& planes,
                   RowWorker& worker);
    /// Sweeps every row of an image, strip by strip, and hands it to `draw(row, sweep, worker)`; what that is given
    /// lives until `finish(worker)`, after a strip's last row.
    template <class Draw, class Finish>
    void sweep_rows(const View& view, const Quality& quality, bool everything_opaque, const PlaneSurfaces& planes,
                    Draw&& draw, Finish&& finish);

    Scene scene;
    Workers workers;
    std::vector<RowWorker> row_workers;
    std::vector<Solid> solids;  // of the scene's objects, then of the models that the host has placed; only ever grows
    std::size_t solid_count = 0;
    std::vector<SolidExtents> extents;  // of the solids
    struct Moving {
        std::uint32_t object;
        Solid at_rest;
    };
    std::vector<Moving> moving;
    std::vector<std::uint32_t> moved;        // indices of solids that are not as they were in the last frame
    std::vector<std::vector<Solid>> models;  // at rest, in their own axes
    FramePaints paints;
    std::vector<std::uint8_t> object_opaque, deck_opaque;  // a byte each: paints are large
    PlaneSurfaces planes;
    ObjectsInView objects;
    StripIndex polygons_on_strips, lights_on_strips;
    std::vector<SeenPolygon> polygons;
    std::vector<SeenLight> lights;
    FrameWork work;
};

void ImageGenerator::Impl::move_objects(const Environment& environment) {
    moved.clear();
    const auto put = [&](std::size_t at, const Solid& at_rest, const ScenePose& pose) {
        moved.push_back(static_cast<std::uint32_t>(at));
        move(at_rest, pose, solids[at]);
        set_extent(at);
    };
    for (const Moving& object : moving)
        put(object.object, object.at_rest, pose_at(scene.objects[object.object], environment.seconds));
    solid_count = scene.objects.size();
    for (const PlacedModel& body : environment.bodies) {
        if (body.model >= models.size()) continue;
        for (std::size_t i = 0; i < models[body.model].size(); ++i, ++solid_count) {
            if (solids.size() <= solid_count)
                solids.emplace_back(), paints.objects.emplace_back(), object_opaque.push_back(1);
            put(solid_count, models[body.model][i], body.pose);
            paints.objects[solid_count] = paints.models[body.model][i];
            object_opaque[solid_count] = !paints.objects[solid_count].translucent;
        }
    }
    for (std::size_t i = solid_count; i < solids.size(); ++i)  // placed before, but no more
        extents[i / SolidExtents::kSolids].clear(i % SolidExtents::kSolids);
}

void ImageGenerator::Impl::look_at_decks(const View& view, const Environment& environment) {
    planes.decks.clear();
    for (std::size_t i = 0; i < scene.cloud_decks.size(); ++i) {
        const CloudDeck& deck = scene.cloud_decks[i];
        const auto state = i < environment.decks.size() ? environment.decks[i] : std::nullopt;
        // No depth at all: nowhere to be seen.
        planes.decks.push_back(
            state && !state->shown ? PlaneDepth{} : horizontal_plane(view, state ? state->altitude : deck.altitude));
        if (!deck_opaque[i])
            paints.decks[i].threshold =
                static_cast<float>(state ? state->threshold : deck.paint.translucence->threshold);
    }
}

void ImageGenerator::Impl::look_at_features(const View& view, const Environment& environment, double pixel_height) {
    const ImagePlane& image = view.image;
    planes.ground = horizontal_plane(view, 0.0);
    planes.has_ground = scene.ground.has_value();
    look_at_decks(view, environment);
    look_at(scene.ground_polygons, view, polygons);
    look_at(scene.lights, view, kLeastLightPixels * pixel_height, lights);
    polygons_on_strips.sort(strips_of(image), polygons.size(), [&](std::size_t i) {
        return strips_between(image, polygons[i].z_from - image.row_step, polygons[i].z_to + image.row_step);
    });
    lights_on_strips.sort(strips_of(image), lights.size(), [&](std::size_t i) {
        const double reach = (lights[i].rows + 1.0) * image.row_step;
        return strips_between(image, lights[i].z - reach, lights[i].z + reach);
    });
}

void ImageGenerator::Impl::add_spans(std::span<const PixelRow> rows, bool everything_opaque,
                                     const PlaneSurfaces& seen_planes, RowWorker& worker) {
    const int strip = rows[0].row / kStripRows;
    const auto on_every_row = [&](auto&& add) {
        for (std::size_t r = 0; r < rows.size(); ++r) add(rows[r], worker.sweeps[r].spans);
    };
    for (std::size_t r = 0; r < rows.size(); ++r) worker.sweeps[r].spans.clear();
    static_assert(kStripRows <= StripCover::kRows);
    worker.cover.clear(rows[0].columns);
    worker.object.set_rows(rows);
    const std::span<const std::uint32_t> on_strip = objects.on(strip);
    for (std::size_t i = 0; i < on_strip.size(); ++i) {
        const std::uint32_t place = on_strip[i];
        // One in the order of depth is not the next in memory: where each is, is fetched some turns ahead.
        constexpr std::size_t kTurnsAhead = 6;
        fetch(objects.bounds(on_strip[std::min(i + kTurnsAhead, on_strip.size() - 1)]));
        const ImageBounds& around = objects.bounds(place);
        const Columns columns = columns_touched(rows[0], around.x_from, around.x_to);
        const StripCover::Rows open = rows_within(rows, around) & worker.cover.open(columns, around.near_u());
        if (open == 0) continue;
        const std::uint32_t object = objects.object(place);
        const bool opaque = everything_opaque || object_opaque[object] != 0;
        worker.object.start(objects.outline(place, worker.outline_time), object, opaque);
        const ObjectSpans::Rows may_show = worker.object.that_may_show();
        StripCover::Covered covered;
        for (std::size_t r = may_show.first; r < may_show.last; ++r) {
            if ((open >> r & 1U) == 0) continue;
            std::vector<RowSpan>& spans = worker.sweeps[r].spans;
            const std::size_t before = spans.size();
            worker.object.add(r, spans);
            if (!opaque || !around.in_front()) continue;
            const CoveredColumns whole = columns_covered(std::span(spans).subspan(before));
            covered.set(r, whole.from, whole.to, whole.far_u);
        }
        worker.cover.add(covered);
    }
    if (!everything_opaque) {
        for (const std::uint32_t i : lights_on_strips.on(strip))
            on_every_row([&](const PixelRow& row, auto& out) { add_light_span(lights[i], row, out); });
        for (const std::uint32_t i : polygons_on_strips.on(strip))
            on_every_row(
                [&](const PixelRow& row, auto& out) { add_polygon_span(polygons[i], seen_planes.ground, row, out); });
    }
    on_every_row([&](const PixelRow& row, auto& out) { add_plane_spans(seen_planes, deck_opaque, row, out); });
}

namespace {

/// The same window from its top left corner on by other pixels, `across` of the old ones wide and high; where that
/// leaves a part of one over, the last ones reach beyond the window.
ImagePlane by_pixels(double across, ImagePlane image) {
    image.width = static_cast<int>(std::ceil(image.width / across));
    image.height = static_cast<int>(std::ceil(image.height / across));
    image.column_step *= across, image.row_step *= across;
    return image;
}

/// Puts the row that was drawn last where it belongs in the picture.
void write_row(RowShader& shader, int row, ShadingRate rate, const FrameImage& image) {
    const double across = pixels_across(rate);
    if (across == 1.0)
        shader.write(image.width, image.row(row));
    else if (across > 1.0)
        shader.write_doubled(image.width, image.row(2 * row),
                             2 * row + 1 < image.height ? image.row(2 * row + 1) : nullptr);
    else if (row % 2 == 0)
        shader.keep_upper();
    else
        shader.write_averaged(image.width, image.row(row / 2));
}

PixelRow pixel_row(const View& view, int r, const Quality& quality) {
    const int sub_lines = quality.lines_per_row();
    PixelRow row;
    row.row = r;
    row.sub_lines = sub_lines;
    row.point_samples = quality.sub_scan_lines == 0;
    row.distance = quality.distance;
    row.columns = view.image.width;
    row.left = view.image.left;
    row.column_step = view.image.column_step;
    row.row_step = view.image.row_step;
    for (int i = 0; i < sub_lines; ++i) row.z[static_cast<std::size_t>(i)] = view.image.z(r + (i + 0.5) / sub_lines);
    return row;
}

}  // namespace

template <class Draw, class Finish>
void ImageGenerator::Impl::sweep_rows(const View& view, const Quality& quality, bool everything_opaque,
                                      const PlaneSurfaces& seen_planes, Draw&& draw, Finish&& finish) {
    for (RowWorker& worker : row_workers)
        worker.outline_time = worker.sweep_time = worker.draw_time = {}, worker.span_count = worker.pair_count = 0;
    const int height = view.image.height;
    const auto task = [&](int strip, int worker) {
        RowWorker& own = row_workers[static_cast<std::size_t>(worker)];
        const auto start = Clock::now();
        const auto outlines_before = own.outline_time;
        std::array<PixelRow, kStripRows> rows;
        const int first = strip * kStripRows, count = std::min(kStripRows, height - first);
        for (int r = 0; r < count; ++r) rows[static_cast<std::size_t>(r)] = pixel_row(view, first + r, quality);
        const auto used = static_cast<std::size_t>(count);
        add_spans({rows.data(), used}, everything_opaque, seen_planes, own);
        auto before = Clock::now();
        own.sweep_time += before - start - (own.outline_time - outlines_before);
        for (std::size_t r = 0; r < used; ++r) {
            RowSweep& sweep = own.sweeps[r];
            own.span_count += sweep.spans.size();
            own.sweeper.sweep(rows[r], sweep);
            own.pair_count += sweep.pairs;
            const auto swept = Clock::now();
            draw(rows[r], sweep, own);
            if (r + 1 == used) finish(own);
            const auto drawn = Clock::now();
            own.sweep_time += swept - before;
            own.draw_time += drawn - swept;
            before = drawn;
        }
    };
    workers.run(strips_of(view.image), std::ref(task));
}

ImageGenerator::ImageGenerator(Scene scene, int threads)
    : impl_(std::make_unique<Impl>(std::move(scene), std::max(1, threads))) {}
ImageGenerator::~ImageGenerator() = default;
const Scene& ImageGenerator::scene() const { return impl_->scene; }
const FrameWork& ImageGenerator::work() const { return impl_->work; }
std::string_view ImageGenerator::simd_target() { return simd_target_name(); }

StageTimes ImageGenerator::render(const View& asked, const Environment& environment, const Quality& quality_asked,
                                  const FrameImage& image) {
    Impl& g = *impl_;
    const double across = pixels_across(quality_asked.shading);
    View view = asked;
    view.image = by_pixels(across, view.image);
    Quality quality = quality_asked;
    quality.smallest_feature /= across;
    const auto start = Clock::now();
    g.move_objects(environment);
    g.objects.select(std::span(g.solids).first(g.solid_count), g.extents, g.moved, view, quality, g.workers);
    const auto selected = Clock::now();

    move_textures(g.scene, view.eye, environment.seconds, quality, g.paints);
    // What is sampled at the middles of its rows only must not slip between them.
    const bool may_slip = quality.sub_scan_lines == 0 && across > 1.0;
    g.look_at_features(view, environment, may_slip ? view.image.row_step : asked.image.row_step);
    const FrameShading frame{glm::transpose(view.eye_from_scene), &g.paints, &g.scene.lights,
                             make_frame_light(g.scene, environment), quality};
    const auto draw_added = [&](RowWorker& own) {
        own.shader.draw(frame, [&](const PixelRow& row) { write_row(own.shader, row.row, quality.shading, image); });
    };
    const auto draw = [&](const PixelRow& row, const RowSweep& sweep, RowWorker& own) {
        own.shader.add(row, sweep);
        if (own.shader.is_full()) draw_added(own);
    };
    g.sweep_rows(view, quality, false, g.planes, draw, draw_added);

    g.work = {};
    g.work.objects = g.objects.count();
    g.work.outlines = g.objects.outlines_made();
    g.work.pixels = static_cast<std::uint64_t>(view.image.width) * static_cast<std::uint64_t>(view.image.height);
    for (RowWorker& worker : g.row_workers) {
        const RowShader::Work drawn = worker.shader.take_work();
        g.work.spans += worker.span_count, g.work.pairs += worker.pair_count, g.work.stretches += drawn.stretches,
            g.work.samples += drawn.samples;
        g.work.terms += drawn.terms, g.work.edge_pixels += drawn.edge_pixels;
    }

    StageTimes times{};
    times[static_cast<std::size_t>(Stage::select)] = selected - start;
    std::chrono::nanoseconds outline{0}, sweep{0}, shade{0};
    for (const RowWorker& worker : g.row_workers)
        outline += worker.outline_time, sweep += worker.sweep_time, shade += worker.draw_time;
    times[static_cast<std::size_t>(Stage::outline)] = outline / g.workers.count();
    times[static_cast<std::size_t>(Stage::sweep)] = sweep / g.workers.count();
    times[static_cast<std::size_t>(Stage::shade)] = shade / g.workers.count();
    return times;
}

GroundTruth ImageGenerator::ground_truth(const View& view, Quality quality, const Environment& environment) {
    Impl& g = *impl_;
    quality.sub_scan_lines = 0;
    const ImagePlane& image = view.image;
    g.move_objects(environment);
    g.objects.select(std::span(g.solids).first(g.solid_count), g.extents, g.moved, view, quality, g.workers);
    const PlaneSurfaces planes{horizontal_plane(view, 0.0), g.scene.ground.has_value(), {}};
    GroundTruth truth;
    truth.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const auto draw = [&](const PixelRow& row, const RowSweep& sweep, RowWorker&) {
        for (const LayerRun& run : sweep.runs) {
            const Surface& surface = sweep.spans[sweep.layers[run.first_layer]].surface;
            if (surface.kind == Surface::Kind::sky) continue;
            const DepthOnLine depth(surface, row, row.z[0]);
            const bool ground = surface.kind == Surface::Kind::ground;
            for (int c = run.from; c < run.to; ++c) {
                const double u = depth.at(c + 0.5).u;
                // A ray along the ground, or along a wall without end, that ends there to a rounding: it meets nothing.
                if (u <= 0.0) continue;
                const auto at = static_cast<std::size_t>(row.row) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(c);
                truth.object_ids[at] = ground ? kGroundId : static_cast<std::int32_t>(surface.outline->object);
                truth.surface_ids[at] = surface.surface;
                truth.depth[at] = 1.0 / u;
            }
        }
    };
    g.sweep_rows(view, quality, true, planes, draw, [](RowWorker&) {});
    return truth;
}

}  // namespace quadrig
