#include "ig_core/clusters/runway.h"

#include <algorithm>
#include <cmath>

#include "ig_core/clusters/turn.h"

namespace quadrig::clusters {
namespace {

/// Axes of one end: metres along the runway from the threshold, and to the right of its centre line.
class RunwayEnd {
  public:
    RunwayEnd(const Runway& runway, bool far)
        : heading_{turned(runway.heading, far)},
          turn_(sine_cosine(runway.heading)),
          origin_(runway.threshold),
          far_(far) {
        if (far) origin_ += runway.length * glm::dvec2(turn_.sine, turn_.cosine);
    }

    [[nodiscard]] glm::dvec2 at(double along, double right) const {
        const double a = far_ ? -along : along, r = far_ ? -right : right;
        return origin_ + glm::dvec2(a * turn_.sine + r * turn_.cosine, a * turn_.cosine - r * turn_.sine);
    }
    [[nodiscard]] GroundPolygon rectangle(double from, double to, double left, double right, const Paint& paint) const {
        return {{at(from, left), at(from, right), at(to, right), at(to, left)}, paint};
    }
    /// Seen by who comes in over this end, or by who comes towards it on the runway.
    [[nodiscard]] LightPoint::Beam to_approach() const { return {turned(heading_, true), {180.0}}; }
    [[nodiscard]] LightPoint::Beam to_runway() const { return {heading_, {180.0}}; }

  private:
    /// The other way round, in -360..360.
    static Degrees turned(Degrees heading, bool round) {
        if (!round) return heading;
        return {heading.value + (heading.value > 0.0 ? -180.0 : 180.0)};
    }

    Degrees heading_;
    SineCosine turn_;
    glm::dvec2 origin_;
    bool far_;
};

/// Annex 14, 5.2.4: how many stripes a threshold has, by the runway's width.
int threshold_stripes(double width) {
    if (width < 23.0) return 4;
    if (width < 30.0) return 6;
    if (width < 45.0) return 8;
    return width < 60.0 ? 12 : 16;
}

void add_markings(const Runway& runway, const RunwayEnd& end, std::vector<GroundPolygon>& out) {
    const Paint white{runway.marking_colour, {}, 0.0, {}};
    const auto pair = [&](double from, double to, double inner, double wide) {
        out.push_back(end.rectangle(from, to, -inner - wide, -inner, white));
        out.push_back(end.rectangle(from, to, inner, inner + wide, white));
    };
    constexpr double kStripe = 1.8, kBegin = 6.0, kLong = 30.0;
    const int stripes = threshold_stripes(runway.width);
    for (int i = 0; i < stripes / 2; ++i) pair(kBegin, kBegin + kLong, kStripe + 2.0 * kStripe * i, kStripe);

    const double half = 0.5 * runway.length;
    const double aiming = runway.length < 1200.0 ? 250.0 : runway.length < 2400.0 ? 300.0 : 400.0;
    if (aiming + 60.0 < half) pair(aiming, aiming + 45.0, 0.2 * runway.width, 0.15 * runway.width);
    for (double at = 150.0; at <= 900.0 && at + 22.5 < half; at += 150.0)
        if (std::abs(at - aiming) > 60.0) pair(at, at + 22.5, 0.2 * runway.width, 3.0);
}

void add_approach_lights(const Runway& runway, const RunwayEnd& end, std::vector<LightPoint>& out) {
    constexpr double kStation = 30.0, kCrossbar = 300.0, kAbove = 0.5;
    const auto add = [&](double before, double right) {
        out.push_back(
            {{{end.at(-before, right), kAbove}}, Colour(1.0), runway.lights->intensity, 0.3, end.to_approach()});
    };
    for (double before = kStation; before <= runway.lights->approach; before += kStation) {
        for (int i = -2; i <= 2; ++i) add(before, 1.0 * i);
        if (before != kCrossbar) continue;
        for (double right = 4.7; right <= 15.0; right += 2.7) add(before, right), add(before, -right);
    }
}

}  // namespace

std::vector<GroundPolygon> polygons_of(const Runway& runway) {
    const RunwayEnd near(runway, false), far(runway, true);
    const double half = 0.5 * runway.width;
    std::vector<GroundPolygon> out{near.rectangle(0.0, runway.length, -half, half, runway.paint)};
    if (!runway.markings) return out;
    const Paint white{runway.marking_colour, {}, 0.0, {}};
    for (const double side : {-1.0, 1.0})
        out.push_back(near.rectangle(0.0, runway.length, side * (half - 0.9), side * half, white));
    // 5.2.3: dashes of 30 m, 20 m between them, 12 m clear of the threshold stripes.
    const double wide = runway.width < 30.0 ? 0.15 : 0.45;
    for (double from = 48.0; from + 30.0 <= runway.length - 48.0; from += 50.0)
        out.push_back(near.rectangle(from, from + 30.0, -wide, wide, white));
    add_markings(runway, near, out);
    add_markings(runway, far, out);
    return out;
}

std::vector<LightPoint> lights_of(const Runway& runway) {
    std::vector<LightPoint> out;
    if (!runway.lights) return out;
    constexpr double kAbove = 0.4, kOutside = 1.5, kThresholdSpacing = 3.0, kDiameter = 0.3;
    const double half = 0.5 * runway.width;
    const RunwayEnd ends[]{RunwayEnd(runway, false), RunwayEnd(runway, true)};
    const auto add = [&](const glm::dvec2& at, const Colour& colour, std::optional<LightPoint::Beam> beam) {
        out.push_back({{{at, kAbove}}, colour, runway.lights->intensity, kDiameter, beam});
    };
    const int spaces = std::max(1, static_cast<int>(std::ceil(runway.length / runway.lights->spacing)));
    for (int i = 0; i <= spaces; ++i)
        for (const double side : {-1.0, 1.0})
            add(ends[0].at(runway.length * i / spaces, side * (half + kOutside)), Colour(1.0, 0.95, 0.85), {});
    for (const RunwayEnd& end : ends) {
        const int gaps = std::max(1, static_cast<int>(std::round(runway.width / kThresholdSpacing)));
        for (int i = 0; i <= gaps; ++i)
            add(end.at(-kOutside, half * (2.0 * i / gaps - 1.0)), Colour(0.1, 1.0, 0.35), end.to_approach());
        for (int i = 0; i <= 5; ++i)
            add(end.at(-kOutside - 0.3, half * (2.0 * i / 5 - 1.0)), Colour(1.0, 0.05, 0.03), end.to_runway());
        add_approach_lights(runway, end, out);
    }
    return out;
}

}  // namespace quadrig::clusters
