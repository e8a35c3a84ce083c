#include "ig_core/outline/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "ig_core/geometry/fetch.h"
#include "ig_core/outline/boundary_lanes.h"
#include "ig_core/outline/convex_rows.h"
#include "ig_core/outline/key_points.h"
#include "ig_core/outline/row_order.h"

namespace quadrig {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Two extrema of every curve, two contacts of every plane, two ends of every edge.
constexpr std::size_t kMaxKeyPoints = 2 + 4 * kMaxEyePlanes + kMaxEyePlanes * (kMaxEyePlanes - 1);

/// Heights of the key points, rising.
std::span<const double> sort_heights(const std::vector<KeyPoint>& keys, std::array<double, kMaxKeyPoints>& sorted) {
    const std::size_t count = keys.size();
    constexpr std::size_t kFew = 32;
    if (count > kFew) {
        std::transform(keys.begin(), keys.end(), sorted.begin(), [](const KeyPoint& key) { return key.zeta; });
        std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
        return {sorted.data(), count};
    }
    // Faster for a few: counting those below each takes no branch that cannot be foreseen.
    std::array<double, kFew> heights;
    std::array<unsigned, kFew> below;
    for (std::size_t i = 0; i < count; ++i) {
        const double height = heights[i] = keys[i].zeta;
        unsigned below_it = 0;
        for (std::size_t j = 0; j < i; ++j) {
            const unsigned is_below = heights[j] <= height ? 1 : 0;
            below_it += is_below, below[j] += 1 - is_below;
        }
        below[i] = below_it;
    }
    for (std::size_t i = 0; i < count; ++i) sorted[below[i]] = heights[i];
    return {sorted.data(), count};
}

/// Bands between key points, as yet without changes. One that holds no row of the grid needs no answer.
void find_bands(const RowGrid& rows, Outline& out) {
    // The picture's edges, not its outermost rows: a picture of one row has a height, too.
    const double z_high = rows.top - out.solid.z0, z_low = z_high - rows.count * rows.step;
    const double rows_per_unit = 1.0 / rows.step;
    struct Height {
        double zeta, row;
    };
    const auto within = [&](double zeta) {
        zeta = std::clamp(zeta, z_low, z_high);
        return Height{zeta, (z_high - zeta) * rows_per_unit - 0.5};
    };
    const auto holds_row = [](const Height& from, const Height& to) {
        constexpr double kRounding = 1e-9;
        const int last_row = static_cast<int>(from.row + 1.0 + kRounding) - 1;  // rounded down: -1/2 at the least
        return last_row >= to.row - kRounding;
    };
    std::array<double, kMaxKeyPoints> memory;
    const std::span<const double> heights = sort_heights(out.key_points, memory);
    if (heights.empty()) return;
    // No branch could foresee which bands hold rows: each is written down, and counted if it does.
    out.bands.resize(heights.size());
    std::size_t count = 0;
    Height from = within(heights[0]);
    for (const double height : heights.subspan(1)) {
        const Height to = within(height);
        out.bands[count].zeta_from = from.zeta, out.bands[count].zeta_to = to.zeta;
        count += static_cast<std::size_t>(to.zeta > from.zeta) & static_cast<std::size_t>(holds_row(from, to));
        from = to;
    }
    out.bands.resize(count);
}

double typical_row(const ZBand& band) { return typical_between(band.zeta_from, band.zeta_to); }

void set_changes(const RowOrder& order, ZBand& band, Outline& out) {
    band.first = static_cast<std::uint32_t>(out.changes.size());
    out.changes.insert(out.changes.end(), order.begin(), order.end());
    band.count = static_cast<std::uint32_t>(out.changes.size()) - band.first;
}

/// What a typical row of each band shows.
void solve_bands(Outline& out) {
    RowOrder order;
    for (ZBand& band : out.bands) {
        solve_row(out, typical_row(band), order);
        set_changes(order, band, out);
    }
}
/// The same of an ellipsoid whole in front of the near plane, by its anchored forms.
void tell_bands(Outline& out) {
    const ConvexRows rows(out);
    ConvexRows::Told told;
    std::array<double, kRowsTogether> zeta;
    for (std::size_t first = 0; first < out.bands.size(); first += kRowsTogether) {
        const std::span bands = std::span(out.bands).subspan(first, std::min(out.bands.size() - first, kRowsTogether));
        std::transform(bands.begin(), bands.end(), zeta.begin(), typical_row);
        rows.tell({zeta.data(), bands.size()}, told);
        for (std::size_t i = 0; i < bands.size(); ++i) {
            if (!told.sure[i]) solve_row(out, zeta[i], told.orders[i]);
            set_changes(told.orders[i], bands[i], out);
        }
    }
}

}  // namespace

void make_outline(const Solid& solid, std::uint32_t object, const ScenePoint& eye, const glm::dmat3& eye_from_scene,
                  const RowGrid& rows, Outline& out, SetUp set_up) {
    make_outline(solid, image_bounds(solid, eye, eye_from_scene), object, eye, eye_from_scene, rows, out, set_up);
}

void make_outline(const Solid& solid, const ImageBounds& bounds, std::uint32_t object, const ScenePoint& eye,
                  const glm::dmat3& eye_from_scene, const RowGrid& rows, Outline& out, SetUp set_up) {
    // What lies outside solid and outline is on its way while the solid is carried into eye space; of the outline's own
    // lists, as much as the last frame filled.
    fetch(std::span(solid.planes)), fetch(std::span(solid.vertices)), fetch(std::span(solid.edges));
    fetch(std::span<const EyePlane>(out.solid.planes));
    fetch(std::span<const ZBand>(out.bands)), fetch(std::span<const Change>(out.changes));
    fetch(std::span<const Curve>(out.curves)), fetch(std::span<const EdgeLine>(out.lines));
    fetch(std::span<const KeyPoint>(out.key_points));
    out.object = object;
    out.show_on_no_row();
    out.lines.clear();
    out.key_points.clear();
    out.bands.clear();
    out.changes.clear();
    out.curves.clear();

    const bool near_plane = !bounds.in_front();
    out.near_u = bounds.near_u();
    out.far_u = bounds.farthest > 0.0 ? 1.0 / bounds.farthest : 0.0;
    const bool endless = solid.may_be_endless;
    look_at(solid, eye, eye_from_scene, near_plane, endless, set_up, out.solid);

    out.direct = endless;
    out.limb_only = solid.planes.empty() && !near_plane && !endless;
    out.curves.push_back({limb_on_rows(out.solid), {}, glm::dvec3(0.0)});
    if (out.limb_only) {
        const RowConic& limb = out.curves[0];
        // The quadric's silhouette spans the rows between its two extrema: b +- sqrt(b^2 - a c) of the row
        // discriminant.
        const double a = limb.discriminant[2], b = 0.5 * limb.discriminant[1], c = limb.discriminant[0];
        const double root = std::sqrt(std::max(0.0, b * b - a * c));
        const double from = (-b + root) / a, to = (-b - root) / a;
        if (a < 0.0 && from < to) out.zeta_from = from, out.zeta_to = to;
        out.curves[0].rows = {out.zeta_from, out.zeta_to};
        return;
    }
    CurveLanes curves;
    find_boundaries(solid, eye_from_scene, out, curves);
    if (out.direct) {
        out.zeta_from = -kInfinity, out.zeta_to = kInfinity;
        return;
    }
    find_key_points(curves, out);
    find_bands(rows, out);
    if (solid.ellipsoid && !near_plane && set_up == SetUp::anchored)
        tell_bands(out);
    else
        solve_bands(out);
    std::erase_if(out.bands, [](const ZBand& band) { return band.count == 0; });
    if (!out.bands.empty()) out.zeta_from = out.bands.front().zeta_from, out.zeta_to = out.bands.back().zeta_to;
}

int cuts_on_row_directly(const Outline& outline, double z, Cut* cuts) {
    int count = 0;
    bool open = false;
    RowOrder order;
    const double zeta = z - outline.solid.z0;
    solve_row(outline, zeta, order);
    for (const Change& change : order) {
        const double x = outline.solid.x0 + intercept(outline, change.boundary, zeta);
        if (open) {
            cuts[count].to = x;
            ++count;
        }
        open = change.surface != kNoSurface && count < kMaxCuts;
        if (open) cuts[count] = {x, x, change.surface};
    }
    return count;
}

void limb_on_lines(const Outline& outline, const double* z, std::size_t count, double* from, double* to) {
    // In the object's own image coordinates beta is small beside the root and alpha far from 0: nothing cancels.
    const RowConic& limb = outline.curves[0];
    const double inverse = 1.0 / limb.alpha, x0 = outline.solid.x0, z0 = outline.solid.z0;
    for (std::size_t i = 0; i < count; ++i) {
        const double zeta = z[i] - z0;
        const double discriminant = limb.discriminant_at(zeta), middle = x0 - limb.beta_at(zeta) * inverse;
        const double reach = -std::sqrt(std::max(0.0, discriminant)) * inverse;  // alpha < 0
        from[i] = discriminant > 0.0 ? middle - reach : 1.0;
        to[i] = discriminant > 0.0 ? middle + reach : 0.0;
    }
}

int cuts_on_row(const Outline& outline, double z, BandPlace& band, Cut* cuts) {
    const std::optional<int> count = cuts_by_band(outline, z, band, cuts);
    return count ? *count : cuts_on_row_directly(outline, z, cuts);
}

const ZBand* band_on_row(const Outline& outline, double zeta, BandPlace& place) {
    const std::vector<ZBand>& bands = outline.bands;
    if (bands.empty()) return nullptr;
    const auto last = static_cast<BandPlace>(bands.size() - 1);
    place = std::min(place, last);
    while (place > 0 && bands[place - 1].zeta_to >= zeta) --place;
    while (place < last && bands[place].zeta_to < zeta) ++place;
    const ZBand& band = bands[place];
    return band.zeta_from <= zeta && zeta <= band.zeta_to ? &band : nullptr;
}

std::optional<int> cuts_by_band(const Outline& outline, double z, BandPlace& place, Cut* cuts) {
    const double zeta = z - outline.solid.z0, x0 = outline.solid.x0;
    if (zeta < outline.zeta_from || zeta > outline.zeta_to) return 0;
    if (outline.direct) return std::nullopt;
    if (outline.limb_only) {
        limb_on_lines(outline, &z, 1, &cuts[0].from, &cuts[0].to);
        cuts[0].surface = 0;
        return cuts[0].from < cuts[0].to ? 1 : 0;
    }
    const ZBand* band = band_on_row(outline, zeta, place);
    if (band == nullptr) return 0;
    std::array<double, RowOrder::kCapacity> xi;
    if (!boundaries_on_line(outline, *band, zeta, xi.data())) return std::nullopt;
    int count = 0;
    for (std::uint32_t i = 0; i + 1 < band->count; ++i) {
        const int surface = outline.changes[band->first + i].surface;
        if (surface != kNoSurface && xi[i + 1] > xi[i] && count < kMaxCuts)
            cuts[count++] = {x0 + xi[i], x0 + xi[i + 1], surface};
    }
    return count;
}

}  // namespace quadrig
