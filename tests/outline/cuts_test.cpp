#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "ig_core/outline/image_bounds.h"
#include "ig_core/outline/outline.h"
#include "tests/ig_core/exact_solid.h"
#include "tests/ig_core/random_objects.h"

using namespace quadrig;
using namespace quadrig::test;

namespace {

/// Image columns. Where a quadric is degenerate (slab, wedge), its limb is a double line, known to the root of rounding
/// only.
constexpr double kDegenerate = 1e-4, kBoundary = 1e-6;

struct CutCase {
    Object object;
    View view;
    Kind kind;
    double boundary;  ///< columns from a change within which both answers are right
};

/// A solid somewhere about the line of sight, from inside to far away, by any attitude and field of view.
CutCase random_case(Randomness& random, double fov) {
    const double size = random.log_between(0.5, 200), distance = random.log_between(0.3, 60) * size;
    const glm::dvec3 eye = random.vector(100);
    const Attitude attitude = random.attitude();
    const glm::dmat3 eye_from_scene = eye_from_scene_rotation(attitude);
    const double spread = 1.5 * std::tan(Degrees{fov}.radians() / 2);
    const glm::dvec3 ahead(random.between(-spread, spread), 1.0, random.between(-spread, spread));
    const glm::dvec3 centre = eye + distance * (glm::transpose(eye_from_scene) * glm::normalize(ahead));
    const Kind kind = random_kind(random);
    return {random_object(random, kind, centre, size),
            {{eye}, eye_from_scene, ImagePlane::symmetric(80, 60, {fov})},
            kind,
            is_degenerate(kind) ? kDegenerate : kBoundary};
}

struct Count {
    long pixels = 0, seen = 0, wrong = 0;
};

/// Compares every pixel centre, apart from those at a change, with a ray cast.
Count compare(const CutCase& given, int trial) {
    const View& view = given.view;
    const ImagePlane& image = view.image;
    const Solid solid = make_solid(given.object);
    const ExactSolid exact = exact_solid(given.object, view.eye);
    const RowGrid rows{image.top, image.row_step, image.height};
    Outline outline;
    make_outline(solid, 7, view.eye, view.eye_from_scene, rows, outline);
    const ImageBounds bounds = image_bounds(solid, view.eye, view.eye_from_scene);
    Count count;
    std::array<Cut, kMaxCuts> cuts;
    for (int r = 0; r < image.height; ++r) {
        const double z = image.z(r + 0.5);
        const bool on_row = !bounds.behind() && z >= bounds.z_from && z <= bounds.z_to;
        const int cut_count = on_row ? cuts_on_row(outline, z, cuts.data()) : 0;
        for (int c = 0; c < image.width; ++c) {
            const double x = image.x(c + 0.5);
            const bool in_column = x >= bounds.x_from && x <= bounds.x_to;
            int surface = -1;
            for (int i = 0; i < (in_column ? cut_count : 0); ++i)
                if (x >= cuts[static_cast<std::size_t>(i)].from && x < cuts[static_cast<std::size_t>(i)].to)
                    surface = cuts[static_cast<std::size_t>(i)].surface;
            const int expected = surface_through(exact, view.eye_from_scene, x, z);
            ++count.pixels;
            count.seen += expected >= 0;
            if (surface == expected) continue;
            if (is_tie(exact, view.eye_from_scene, x, z, given.boundary * image.column_step,
                       given.boundary * image.row_step))
                continue;
            if (count.wrong++ == 0)
                UNSCOPED_INFO("trial " << trial << ", kind " << static_cast<int>(given.kind) << ", column " << c
                                       << ", row " << r << ": surface " << surface << ", by ray " << expected);
        }
    }
    return count;
}

}  // namespace

TEST_CASE("a solid's cuts name the surface that a ray cast names, at every pixel centre") {
    CAPTURE(seed());
    Count total;
    int wrong_solids = 0;
    for (int trial = 0; trial < trials(1500, 500); ++trial) {
        Randomness random(trial);
        const Count count = compare(random_case(random, random.log_between(1, 170)), trial);
        total.pixels += count.pixels, total.seen += count.seen, total.wrong += count.wrong;
        wrong_solids += count.wrong > 0;
    }
    CAPTURE(wrong_solids, total.pixels);
    CHECK(total.wrong == 0);
    CHECK(total.seen > total.pixels / 50);
}

TEST_CASE("cuts through z-bands are those of the row solved by itself, from left to right, never empty or NaN") {
    CAPTURE(seed());
    int rows_with_bands = 0;
    for (int trial = 0; trial < trials(1000); ++trial) {
        Randomness random(100'000 + trial);
        const CutCase given = random_case(random, random.log_between(5, 120));
        const ImagePlane& image = given.view.image;
        const RowGrid rows{image.top, image.row_step / 4, 4 * image.height};
        Outline outline;
        make_outline(make_solid(given.object), 0, given.view.eye, given.view.eye_from_scene, rows, outline);
        CAPTURE(trial);
        for (int r = 0; r < rows.count; ++r) {
            std::array<Cut, kMaxCuts> banded, direct;
            const double z = rows.z(r);
            const int banded_count = cuts_on_row(outline, z, banded.data());
            const int direct_count = cuts_on_row_directly(outline, z, direct.data());
            rows_with_bands += banded_count > 0 && !outline.direct;
            CAPTURE(r, banded_count, direct_count);
            double left = -std::numeric_limits<double>::infinity();
            const auto width = [&](const auto& cuts, int n, int surface, double from, double to) {
                double sum = 0;
                for (int i = 0; i < n; ++i) {
                    const Cut& cut = cuts[static_cast<std::size_t>(i)];
                    if (cut.surface == surface) sum += std::max(0.0, std::min(cut.to, to) - std::max(cut.from, from));
                }
                return sum;
            };
            for (int i = 0; i < banded_count; ++i) {
                const Cut& cut = banded[static_cast<std::size_t>(i)];
                REQUIRE(cut.from >= left);
                REQUIRE(cut.to > cut.from);
                REQUIRE(cut.surface >= 0);
                left = cut.to;
            }
            for (int surface = 0; surface <= static_cast<int>(given.object.planes.size()); ++surface) {
                const double from = image.left, to = image.x(image.width);
                const double difference =
                    width(banded, banded_count, surface, from, to) - width(direct, direct_count, surface, from, to);
                REQUIRE(std::abs(difference) < kDegenerate * image.column_step);
            }
        }
    }
    CHECK(rows_with_bands > 1000);
}

TEST_CASE("z-bands follow one another upwards, and together hold every row that shows something") {
    CAPTURE(seed());
    int banded_solids = 0;
    for (int trial = 0; trial < trials(500); ++trial) {
        Randomness random(200'000 + trial);
        const CutCase given = random_case(random, 60);
        const ImagePlane& image = given.view.image;
        const RowGrid rows{image.top, image.row_step, image.height};
        Outline outline;
        make_outline(make_solid(given.object), 0, given.view.eye, given.view.eye_from_scene, rows, outline);
        if (outline.direct || outline.limb_only) continue;
        ++banded_solids;
        CAPTURE(trial);
        double below = -std::numeric_limits<double>::infinity();
        for (const ZBand& band : outline.bands) {
            REQUIRE(band.zeta_from >= below);
            REQUIRE(band.zeta_to > band.zeta_from);
            REQUIRE(band.first + band.count <= outline.changes.size());
            below = band.zeta_to;
        }
        for (int r = 0; r < rows.count; ++r) {
            std::array<Cut, kMaxCuts> cuts;
            const int count = cuts_on_row_directly(outline, rows.z(r), cuts.data());
            double covered = 0;
            for (int i = 0; i < count; ++i)
                covered += cuts[static_cast<std::size_t>(i)].to - cuts[static_cast<std::size_t>(i)].from;
            if (!(covered > kDegenerate * image.column_step)) continue;
            const double zeta = rows.z(r) - outline.solid.z0;
            const bool held = std::any_of(outline.bands.begin(), outline.bands.end(), [&](const ZBand& band) {
                return zeta >= band.zeta_from && zeta <= band.zeta_to;
            });
            REQUIRE(held);
        }
    }
    CHECK(banded_solids > 100);
}

TEST_CASE("a scan line's cuts are the same wherever its z-band is looked for from") {
    CAPTURE(seed());
    int rows_with_cuts = 0;
    for (int trial = 0; trial < trials(300); ++trial) {
        Randomness random(200'000 + trial);
        const CutCase given = random_case(random, random.log_between(5, 120));
        const ImagePlane& image = given.view.image;
        Outline outline;
        make_outline(make_solid(given.object), 0, given.view.eye, given.view.eye_from_scene,
                     {image.top, image.row_step, image.height}, outline);
        CAPTURE(trial);
        BandPlace kept = kHighestBand;
        for (int r = 0; r < image.height; ++r) {
            const double z = image.z(r + 0.5);
            BandPlace anywhere = static_cast<BandPlace>(random.below(60));
            std::array<Cut, kMaxCuts> fresh, next, other;
            const int count = cuts_on_row(outline, z, fresh.data());
            REQUIRE(cuts_on_row(outline, z, kept, next.data()) == count);
            REQUIRE(cuts_on_row(outline, z, anywhere, other.data()) == count);
            rows_with_cuts += count > 0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                for (const Cut& cut : {next[i], other[i]}) {
                    REQUIRE(cut.from == fresh[i].from);
                    REQUIRE(cut.to == fresh[i].to);
                    REQUIRE(cut.surface == fresh[i].surface);
                }
        }
    }
    CHECK(rows_with_cuts > 0);
}
