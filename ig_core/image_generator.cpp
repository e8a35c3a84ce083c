#include "ig_core/image_generator.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "ig_core/scene/deck_coverage.h"
#include "ig_core/scene/motion.h"
#include "ig_core/select.h"
#include "ig_core/shading/row_shader.h"
#include "ig_core/spans/row_spans.h"
#include "ig_core/spans/seen_features.h"
#include "ig_core/strip_index.h"
#include "ig_core/workers.h"

namespace quadrig {
namespace {

using Clock = std::chrono::steady_clock;

/// Rows are handed out in strips, so that objects are looked up once for several rows.
constexpr int kStripRows = 8;  // even: both rows of a pixel that is drawn twice as fine
constexpr int kSelectBlock = 512, kOutlineBlock = 8;

/// 1/k of the plane Z = altitude over the image: P(k d) = height + k n.d (Eq 7).
PlaneDepth horizontal_plane(const View& view, double altitude) {
    const double height = view.eye.metres.z - altitude;
    const glm::dvec3 up = view.eye_from_scene[2];
    if (height == 0.0) return {};  // edge-on: nowhere in front
    return {-up.y / height, -up.x / height, -up.z / height};
}

int sub_lines_of(const Quality& quality) { return std::clamp(quality.sub_scan_lines, 1, kMaxSubScanLines); }

/// Scratch of one worker; nothing in it survives a row but its memory.
struct RowWorker {
    RowSweep sweep;
    RowShader shader;
    std::chrono::nanoseconds sweep_time{0}, shade_time{0};
};

}  // namespace

struct ImageGenerator::Impl {
    Impl(Scene s, int threads) : scene(std::move(s)), workers(threads), row_workers(static_cast<std::size_t>(threads)) {
        solids.reserve(scene.objects.size());
        for (const Object& object : scene.objects) solids.push_back(make_solid(object));
        for (const Solid& solid : solids) spheres.push_back({solid.anchor.metres, solid.radius});
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
            if (scene.objects[i].motion) moving.push_back({i, solids[i]});
        for (const Model& model : scene.models) {
            std::vector<Solid>& at_rest = models.emplace_back();
            for (const Object& object : model.objects) at_rest.push_back(make_solid(object));
        }
        paints = make_frame_paints(scene);
        for (std::size_t i = 0; i < scene.cloud_decks.size(); ++i) {
            const Paint& paint = scene.cloud_decks[i].paint;
            deck_opaque.push_back(!paints.decks[i].translucent);
            deck_coverages.emplace_back();
            if (paints.decks[i].translucent)
                deck_coverages.back().emplace(scene.textures[*paint.texture], *paint.translucence);
        }
    }

    /// Puts what moves where it is: objects by scene time, models by the host.
    void move_objects(const Environment& environment);

    void select(const View& view);
    void make_outlines(const View& view, const Quality& quality);
    void assign_strips(const View& view, double smallest_feature);
    /// Ground, decks, markings and lights.
    void look_at_features(const View& view, const Environment& environment, double pixel_height);
    void look_at_decks(const View& view, const Environment& environment);
    /// Spans of one row, swept.
    void sweep_row(const PixelRow& row, bool everything_opaque, const PlaneSurfaces& planes, RowSweep& sweep) const;

    Scene scene;
    Workers workers;
    std::vector<RowWorker> row_workers;
    std::vector<Solid> solids;  // of the scene's objects, then of the models that the host has placed; only ever grows
    std::size_t solid_count = 0;
    std::vector<BoundingSphere> spheres;  // of the solids
    struct Moving {
        std::uint32_t object;
        Solid at_rest;
    };
    std::vector<Moving> moving;
    std::vector<std::vector<Solid>> models;  // at rest, in their own axes
    FramePaints paints;
    std::vector<std::uint8_t> deck_opaque;
    std::vector<std::optional<DeckCoverage>> deck_coverages;  // of those with holes
    PlaneSurfaces planes;
    std::vector<std::uint8_t> may_be_seen;
    std::vector<std::uint32_t> selected;
    std::vector<Outline> outlines;  // one for each selected object; only ever grows, to keep its memory
    StripIndex on_strips, polygons_on_strips, lights_on_strips;
    PlaneDepth marked_plane;
    std::vector<SeenPolygon> polygons;
    std::vector<SeenLight> lights;
};

void ImageGenerator::Impl::move_objects(const Environment& environment) {
    const auto put = [&](std::size_t at, const Solid& at_rest, const ScenePose& pose) {
        move(at_rest, pose, solids[at]);
        spheres[at] = {solids[at].anchor.metres, solids[at].radius};
    };
    for (const Moving& object : moving)
        put(object.object, object.at_rest, pose_at(scene.objects[object.object], environment.seconds));
    solid_count = scene.objects.size();
    for (const PlacedModel& body : environment.bodies) {
        if (body.model >= models.size()) continue;
        for (std::size_t i = 0; i < models[body.model].size(); ++i, ++solid_count) {
            if (solids.size() <= solid_count)
                solids.emplace_back(), spheres.emplace_back(), paints.objects.emplace_back();
            put(solid_count, models[body.model][i], body.pose);
            paints.objects[solid_count] = paints.models[body.model][i];
        }
    }
}

void ImageGenerator::Impl::select(const View& view) {
    const ImagePlane& image = view.image;
    const auto count = static_cast<int>(solid_count);
    may_be_seen.resize(solid_count);
    const auto walls = walls_of(view);
    const auto task = [&](int block, int) {
        const int end = std::min(count, (block + 1) * kSelectBlock);
        for (int i = block * kSelectBlock; i < end; ++i)
            may_be_seen[static_cast<std::size_t>(i)] =
                spheres[static_cast<std::size_t>(i)].reaches_into(walls) &&
                may_be_in_view(solids[static_cast<std::size_t>(i)], view.eye, view.eye_from_scene, image.left,
                               image.x(image.width), image.z(image.height), image.top);
    };
    workers.run((count + kSelectBlock - 1) / kSelectBlock, std::ref(task));
    selected.clear();
    for (std::uint32_t i = 0; i < may_be_seen.size(); ++i)
        if (may_be_seen[i] != 0) selected.push_back(i);
}

void ImageGenerator::Impl::make_outlines(const View& view, const Quality& quality) {
    const int sub_lines = sub_lines_of(quality);
    const RowGrid rows{view.image.top, view.image.row_step / sub_lines, view.image.height * sub_lines};
    if (outlines.size() < selected.size()) outlines.resize(selected.size());
    const auto count = static_cast<int>(selected.size());
    const auto task = [&](int block, int) {
        const int end = std::min(count, (block + 1) * kOutlineBlock);
        for (int i = block * kOutlineBlock; i < end; ++i) {
            const std::uint32_t object = selected[static_cast<std::size_t>(i)];
            make_outline(solids[object], object, view.eye, view.eye_from_scene, rows,
                         outlines[static_cast<std::size_t>(i)], quality.set_up);
        }
    };
    workers.run((count + kOutlineBlock - 1) / kOutlineBlock, std::ref(task));
    assign_strips(view, quality.smallest_feature);
}

void ImageGenerator::Impl::assign_strips(const View& view, double smallest_feature) {
    const ImagePlane& image = view.image;
    const int strips = (image.height + kStripRows - 1) / kStripRows;
    const auto strips_of = [&](const Outline& outline) {
        const double first = (image.top - (outline.zeta_to + outline.solid.z0)) / image.row_step;
        const double last = (image.top - (outline.zeta_from + outline.solid.z0)) / image.row_step;
        if (!(outline.zeta_from <= outline.zeta_to) || !(last >= 0.0) || !(first <= image.height) ||
            last - first < smallest_feature)
            return std::pair{1, 0};
        const auto strip = [&](double row) {
            return static_cast<int>(std::clamp(std::floor(row), 0.0, image.height - 1.0)) / kStripRows;
        };
        return std::pair{strip(first), strip(last)};
    };
    on_strips.sort(strips, selected.size(), [&](std::size_t i) { return strips_of(outlines[i]); });
}

void ImageGenerator::Impl::look_at_decks(const View& view, const Environment& environment) {
    planes.decks.clear();
    for (std::size_t i = 0; i < scene.cloud_decks.size(); ++i) {
        const CloudDeck& deck = scene.cloud_decks[i];
        const auto state = i < environment.decks.size() ? environment.decks[i] : std::nullopt;
        // No depth at all: nowhere to be seen.
        planes.decks.push_back(
            state && !state->shown ? PlaneDepth{} : horizontal_plane(view, state ? state->altitude : deck.altitude));
        if (const auto& coverage = deck_coverages[i])
            paints.decks[i].threshold =
                static_cast<float>(state ? coverage->threshold(state->coverage) : deck.paint.translucence->threshold);
    }
}

void ImageGenerator::Impl::look_at_features(const View& view, const Environment& environment, double pixel_height) {
    const ImagePlane& image = view.image;
    planes.ground.reset();
    if (scene.ground) planes.ground = horizontal_plane(view, 0.0);
    look_at_decks(view, environment);
    marked_plane = horizontal_plane(view, 0.0);
    look_at(scene.ground_polygons, view, polygons);
    look_at(scene.lights, view, kLeastLightPixels * pixel_height, lights);
    const int strips = (image.height + kStripRows - 1) / kStripRows;
    const auto strips_of = [&](double z_from, double z_to) {
        const auto strip = [&](double z) {
            const double row = std::floor((image.top - z) / image.row_step);
            return static_cast<int>(std::clamp(row, 0.0, image.height - 1.0)) / kStripRows;
        };
        return std::pair{strip(z_to), strip(z_from)};
    };
    polygons_on_strips.sort(strips, polygons.size(), [&](std::size_t i) {
        return strips_of(polygons[i].z_from - image.row_step, polygons[i].z_to + image.row_step);
    });
    lights_on_strips.sort(strips, lights.size(), [&](std::size_t i) {
        const double reach = (lights[i].rows + 1.0) * image.row_step;
        return strips_of(lights[i].z - reach, lights[i].z + reach);
    });
}

void ImageGenerator::Impl::sweep_row(const PixelRow& row, bool everything_opaque, const PlaneSurfaces& seen_planes,
                                     RowSweep& sweep) const {
    sweep.spans.clear();
    const int strip = row.row / kStripRows;
    for (const std::uint32_t i : on_strips.on(strip)) {
        const Outline& outline = outlines[i];
        const bool opaque = everything_opaque || !paints.objects[outline.object].translucent;
        add_object_spans(outline, i, opaque, row, sweep.spans);
    }
    if (!everything_opaque) {
        for (const std::uint32_t i : lights_on_strips.on(strip)) add_light_span(lights[i], row, sweep.spans);
        for (const std::uint32_t i : polygons_on_strips.on(strip))
            add_polygon_span(polygons[i], marked_plane, row, sweep.spans);
    }
    add_plane_spans(seen_planes, deck_opaque, row, sweep.spans);
    sweep.sweep(row);
}

namespace {

/// The same window with four pixels for each.
ImagePlane twice_as_fine(ImagePlane image) {
    image.width *= 2, image.height *= 2;
    image.column_step *= 0.5, image.row_step *= 0.5;
    return image;
}

PixelRow pixel_row(const View& view, int r, const Quality& quality) {
    const int sub_lines = sub_lines_of(quality);
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

ImageGenerator::ImageGenerator(Scene scene, int threads)
    : impl_(std::make_unique<Impl>(std::move(scene), std::max(1, threads))) {}
ImageGenerator::~ImageGenerator() = default;
const Scene& ImageGenerator::scene() const { return impl_->scene; }
std::string_view ImageGenerator::simd_target() { return simd_target_name(); }

StageTimes ImageGenerator::render(const View& asked, const Environment& environment, const Quality& quality_asked,
                                  const FrameImage& image) {
    Impl& g = *impl_;
    const bool fine = quality_asked.shading == ShadingRate::four;
    View view = asked;
    Quality quality = quality_asked;
    if (fine) {
        view.image = twice_as_fine(view.image);
        quality.smallest_feature *= 2.0;
    }
    const auto start = Clock::now();
    g.move_objects(environment);
    g.select(view);
    const auto selected = Clock::now();
    g.make_outlines(view, quality);
    const auto outlined = Clock::now();

    move_textures(g.scene, view.eye, environment.seconds, quality, g.paints);
    g.look_at_features(view, environment, asked.image.row_step);
    const FrameShading frame{&view,  &g.solids, &g.paints, &g.scene.lights, make_frame_light(g.scene, environment),
                             quality};
    for (RowWorker& worker : g.row_workers) worker.sweep_time = worker.shade_time = {};

    const auto task = [&](int strip, int worker) {
        RowWorker& own = g.row_workers[static_cast<std::size_t>(worker)];
        auto before = Clock::now();
        for (int r = strip * kStripRows; r < std::min(view.image.height, (strip + 1) * kStripRows); ++r) {
            const PixelRow row = pixel_row(view, r, quality);
            g.sweep_row(row, false, g.planes, own.sweep);
            const auto swept = Clock::now();
            own.shader.draw(frame, row, own.sweep);
            if (!fine)
                own.shader.write(image.width, image.row(r));
            else if (r % 2 == 0)
                own.shader.keep_upper();
            else
                own.shader.write_averaged(image.width, image.row(r / 2));
            const auto shaded = Clock::now();
            own.sweep_time += swept - before;
            own.shade_time += shaded - swept;
            before = shaded;
        }
    };
    g.workers.run((view.image.height + kStripRows - 1) / kStripRows, std::ref(task));

    StageTimes times{};
    times[static_cast<std::size_t>(Stage::select)] = selected - start;
    times[static_cast<std::size_t>(Stage::outline)] = outlined - selected;
    std::chrono::nanoseconds sweep{0}, shade{0};
    for (const RowWorker& worker : g.row_workers) sweep += worker.sweep_time, shade += worker.shade_time;
    times[static_cast<std::size_t>(Stage::sweep)] = sweep / g.workers.count();
    times[static_cast<std::size_t>(Stage::shade)] = shade / g.workers.count();
    return times;
}

GroundTruth ImageGenerator::ground_truth(const View& view, Quality quality, const Environment& environment) {
    Impl& g = *impl_;
    quality.sub_scan_lines = 0;
    const ImagePlane& image = view.image;
    g.move_objects(environment);
    g.select(view);
    g.make_outlines(view, quality);
    PlaneSurfaces planes;
    if (g.scene.ground) planes.ground = horizontal_plane(view, 0.0);
    GroundTruth truth;
    truth.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const auto task = [&](int strip, int worker) {
        RowSweep& sweep = g.row_workers[static_cast<std::size_t>(worker)].sweep;
        for (int r = strip * kStripRows; r < std::min(image.height, (strip + 1) * kStripRows); ++r) {
            const PixelRow row = pixel_row(view, r, quality);
            g.sweep_row(row, true, planes, sweep);
            for (const LayerRun& run : sweep.runs) {
                const Surface& surface = sweep.spans[sweep.layers[run.first_layer]].surface;
                if (surface.kind == Surface::Kind::sky) continue;
                const DepthOnLine depth(surface, row, row.z[0]);
                const bool ground = surface.kind == Surface::Kind::ground;
                for (int c = run.from; c < run.to; ++c) {
                    const auto at = static_cast<std::size_t>(r) * static_cast<std::size_t>(image.width) +
                                    static_cast<std::size_t>(c);
                    truth.object_ids[at] = ground ? kGroundId : static_cast<std::int32_t>(surface.outline->object);
                    truth.surface_ids[at] = surface.surface;
                    truth.depth[at] = 1.0 / depth.at(c + 0.5).u;
                }
            }
        }
    };
    g.workers.run((image.height + kStripRows - 1) / kStripRows, std::ref(task));
    return truth;
}

}  // namespace quadrig
