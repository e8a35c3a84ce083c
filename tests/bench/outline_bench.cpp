/// Visibility: outline set-up, cuts on rows, the sweep; and how many rows needed the direct solution.
#include <benchmark/benchmark.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "config/camera_path.h"
#include "config/scene_file.h"
#include "ig_core/spans/object_spans.h"
#include "ig_core/spans/row_spans.h"
#include "ig_core/spans/sweep.h"
#include "ig_core/strip_index.h"
#include "ig_core/view.h"
#include "tests/hard_cases/catalogue.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

constexpr int kWidth = 1280, kHeight = 720;
static_assert(kHeight % kStripRows == 0);

View view_of(const config::Camera& camera) {
    return {camera.eye, eye_from_scene_rotation(camera.attitude),
            ImagePlane::symmetric(kWidth, kHeight, camera.horizontal_fov)};
}

RowGrid rows_of(const View& view, int sub_lines) {
    return {view.image.top, view.image.row_step / sub_lines, view.image.height * sub_lines};
}

/// Ellipsoids in view, each cut by planes at random attitude that touch a sphere of half its size or so about its
/// centre.
std::vector<Solid> solids_with_planes(int planes) {
    std::vector<Solid> solids;
    for (int i = 0; i < 256; ++i) {
        Randomness random(i);
        Object object;
        const glm::dvec3 centre(random.between(-150, 150), random.between(300, 900), random.between(-80, 80));
        const glm::dvec3 axes(random.between(8, 25), random.between(8, 25), random.between(8, 25));
        object.shape = Ellipsoid{{centre}, axes, random.attitude()};
        for (int j = 0; j < planes; ++j) {
            const glm::dvec3 n = random.direction();
            object.planes.push_back({n.x, n.y, n.z, random.between(5, 12) - glm::dot(n, centre)});
        }
        solids.push_back(make_solid(object));
    }
    return solids;
}

void outline_set_up(benchmark::State& state) {
    const std::vector<Solid> solids = solids_with_planes(static_cast<int>(state.range(0)));
    const View view{{}, glm::dmat3(1.0), ImagePlane::symmetric(kWidth, kHeight, {60})};
    const RowGrid rows = rows_of(view, 2);
    std::vector<ImageBounds> bounds;  // known from select
    for (const Solid& solid : solids) bounds.push_back(image_bounds(solid, view.eye, view.eye_from_scene));
    Outline outline;
    std::size_t next = 0;
    for (auto _ : state) {
        make_outline(solids[next], bounds[next], 0, view.eye, view.eye_from_scene, rows, outline);
        benchmark::DoNotOptimize(outline.zeta_to);
        next = (next + 1) % solids.size();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(outline_set_up)->ArgName("planes")->Arg(0)->Arg(1)->Arg(6)->Arg(16);

/// One cut of one object on one scan line.
void cuts_on_a_row(benchmark::State& state) {
    const std::vector<Solid> solids = solids_with_planes(static_cast<int>(state.range(0)));
    const View view{{}, glm::dmat3(1.0), ImagePlane::symmetric(kWidth, kHeight, {60})};
    const RowGrid rows = rows_of(view, 2);
    std::vector<Outline> outlines(solids.size());
    for (std::size_t i = 0; i < solids.size(); ++i)
        make_outline(solids[i], 0, view.eye, view.eye_from_scene, rows, outlines[i]);
    std::array<Cut, kMaxCuts> cuts;
    std::int64_t found = 0;
    for (auto _ : state)
        for (const Outline& outline : outlines) {
            const double z = outline.solid.z0 + 0.5 * (outline.zeta_from + outline.zeta_to);
            found += cuts_on_row(outline, z, cuts.data());
        }
    state.counters["ns_per_cut"] = benchmark::Counter(static_cast<double>(found) * 1e-9,
                                                      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(cuts_on_a_row)->ArgName("planes")->Arg(0)->Arg(6);

/// Spans and sweep of all rows of a demo scene, strip by strip as in a frame; but nothing is hidden beforehand.
void sweep_of_rows(benchmark::State& state) {
    const std::string folder = QUADRIG_SOURCE_DIR "/config/scenes/";
    const Scene scene = config::read_scene(folder + "takeoff.toml");
    const View view =
        view_of(config::read_camera_path(folder + "takeoff_cameras.json")[static_cast<std::size_t>(state.range(0))]);
    const ImagePlane& image = view.image;
    constexpr int kSubLines = 2;
    std::vector<Outline> outlines(scene.objects.size());
    for (std::size_t i = 0; i < outlines.size(); ++i)
        make_outline(make_solid(scene.objects[i]), static_cast<std::uint32_t>(i), view.eye, view.eye_from_scene,
                     rows_of(view, kSubLines), outlines[i]);
    StripIndex on_strips;
    on_strips.sort(strips_of(image), outlines.size(), [&](std::size_t i) {
        const double z0 = outlines[i].solid.z0;
        return strips_between(image, z0 + outlines[i].zeta_from, z0 + outlines[i].zeta_to);
    });
    std::vector<PixelRow> rows_of_image(kHeight);
    for (int r = 0; r < kHeight; ++r) {
        PixelRow& row = rows_of_image[static_cast<std::size_t>(r)];
        row.row = r, row.sub_lines = kSubLines, row.columns = kWidth;
        row.left = image.left, row.column_step = image.column_step, row.row_step = image.row_step;
        for (int i = 0; i < kSubLines; ++i) row.z[static_cast<std::size_t>(i)] = image.z(r + (i + 0.5) / kSubLines);
    }
    ObjectSpans object;
    std::array<RowSweep, kStripRows> sweeps;
    RowSweeper sweeper;
    std::int64_t spans = 0;
    for (auto _ : state)
        for (int strip = 0; strip < strips_of(image); ++strip) {
            const std::span rows = std::span<const PixelRow>(rows_of_image)
                                       .subspan(static_cast<std::size_t>(strip * kStripRows), kStripRows);
            for (RowSweep& sweep : sweeps) sweep.spans.clear();
            object.set_rows(rows);
            for (const std::uint32_t i : on_strips.on(strip)) {
                object.start(outlines[i], i, !scene.objects[i].paint.translucence);
                const ObjectSpans::Rows may_show = object.that_may_show();
                for (std::size_t r = may_show.first; r < may_show.last; ++r) object.add(r, sweeps[r].spans);
            }
            for (std::size_t r = 0; r < rows.size(); ++r) {
                add_plane_spans({}, {}, rows[r], sweeps[r].spans);
                sweeper.sweep(rows[r], sweeps[r]);
                spans += static_cast<std::int64_t>(sweeps[r].spans.size());
            }
        }
    const std::int64_t rows = state.iterations() * kHeight;
    state.counters["us_per_row"] =
        benchmark::Counter(static_cast<double>(rows) * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["ns_per_span"] = benchmark::Counter(static_cast<double>(spans) * 1e-9,
                                                       benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["spans_per_row"] = static_cast<double>(spans) / static_cast<double>(rows);
}
BENCHMARK(sweep_of_rows)->ArgName("camera")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

struct RowTally {
    std::int64_t rows = 0, direct = 0, endless = 0;
    /// Scan lines on which the objects of a scene show, and those among them that no z-band could answer.
    void add(const Scene& scene, const View& view) {
        std::array<Cut, kMaxCuts> cuts;
        Outline outline;
        const RowGrid grid = rows_of(view, 2);
        for (const Object& object : scene.objects) {
            make_outline(make_solid(object), 0, view.eye, view.eye_from_scene, grid, outline);
            BandPlace band = kHighestBand;
            for (int r = 0; r < grid.count; ++r) {
                const auto count = cuts_by_band(outline, grid.z(r), band, cuts.data());
                if (count && *count == 0) continue;
                ++rows;
                direct += !count && !outline.direct;
                endless += !count && outline.direct;
            }
        }
    }
    void report(benchmark::State& state) const {
        state.counters["rows"] = static_cast<double>(rows);
        state.counters["direct_percent"] = 100.0 * static_cast<double>(direct) / static_cast<double>(rows);
        state.counters["endless_percent"] = 100.0 * static_cast<double>(endless) / static_cast<double>(rows);
    }
};

/// Not a time: the share of rows whose z-band did not hold, and of rows of solids that have none.
void direct_rows_of_demo_scenes(benchmark::State& state) {
    RowTally tally;
    for (auto _ : state) {
        tally = {};
        const std::string folder = QUADRIG_SOURCE_DIR "/config/scenes/";
        const Scene scene = config::read_scene(folder + "takeoff.toml");
        for (const config::Camera& camera : config::read_camera_path(folder + "takeoff_cameras.json"))
            tally.add(scene, view_of(camera));
    }
    tally.report(state);
}
BENCHMARK(direct_rows_of_demo_scenes)->Iterations(1)->Unit(benchmark::kMillisecond);

void direct_rows_of_hard_cases(benchmark::State& state) {
    RowTally tally;
    for (auto _ : state) {
        tally = {};
        for (const auto& file : hard_case_files()) {
            const HardCase hard_case = read_hard_case(file);
            tally.add(hard_case.scene, hard_case.view);
        }
    }
    tally.report(state);
}
BENCHMARK(direct_rows_of_hard_cases)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
