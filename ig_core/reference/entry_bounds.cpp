#include "ig_core/reference/entry_bounds.h"

#include <algorithm>
#include <cmath>

namespace quadrig::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Covers the rounding of a sum of ten products and of the numbers in it: 2^-53 each.
constexpr double kRounding = 0x1p-48;

/// A number known to within `radius`, its own rounding included.
struct Ball {
    double middle = 0.0;
    double radius = 0.0;

    [[nodiscard]] double low() const { return middle - radius; }
    [[nodiscard]] double high() const { return middle + radius; }
    [[nodiscard]] bool has_sign() const { return std::abs(middle) > radius; }
};

Ball operator-(const Ball& a, const Ball& b) {
    return {a.middle - b.middle, a.radius + b.radius + kRounding * (std::abs(a.middle) + std::abs(b.middle))};
}
Ball operator-(const Ball& a) { return {-a.middle, a.radius}; }
Ball operator*(const Ball& a, const Ball& b) {
    const double product = a.middle * b.middle;
    return {product,
            std::abs(a.middle) * b.radius + a.radius * (std::abs(b.middle) + b.radius) + kRounding * std::abs(product)};
}
/// The divisor must have a sign.
Ball operator/(const Ball& a, const Ball& b) {
    const double quotient = a.middle / b.middle;
    return {quotient, (a.radius + std::abs(quotient) * b.radius) / (std::abs(b.middle) - b.radius) +
                          kRounding * std::abs(quotient)};
}
/// Of a ball that is positive throughout.
Ball square_root(const Ball& a) {
    const double root = std::sqrt(a.middle);
    return {root, a.radius / std::sqrt(a.low()) + kRounding * root};
}

double length(const Vector<double>& v) { return std::sqrt(dot(v, v)); }

/// n.d over the bundle.
Ball rate_of(const Vector<double>& normal, const Vector<double>& direction, double reach) {
    return {dot(normal, direction), length(normal) * (reach + kRounding * length(direction))};
}

/// The stretches of the rays where Q < 0, in order, empty ones left out.
struct Stretch {
    Ball begin{-kInfinity, 0.0}, end{kInfinity, 0.0};
};
struct Stretches {
    Stretch at[2];
    int count = 0;
    bool in_doubt = false;  ///< there may be fewer, and they may be shorter
};

Stretches inside_quadric(const Quadric<double>& q, const Vector<double>& d, double reach) {
    Stretches result;
    const auto is = [&](std::initializer_list<Stretch> stretches) {
        for (const Stretch& stretch : stretches) result.at[result.count++] = stretch;
        return result;
    };
    const Vector<double> md = times(q.m, d);
    const double m_scale = static_cast<double>(q.m_scale), v_length = length(q.v), d_length = length(d);
    const Ball a{dot(d, md), reach * (2 * length(md) + reach * m_scale) + kRounding * m_scale * d_length * d_length};
    const Ball b{dot(q.v, d), v_length * (reach + kRounding * d_length)};
    const Ball c{q.s, kRounding * std::abs(q.s)};
    if (m_scale == 0 && v_length == 0) return q.s > 0 ? result : is({{}});

    const Ball discriminant = b * b - a * c;
    if (discriminant.high() < 0) return a.middle > 0 ? result : is({{}});  // a c > b^2 >= 0, so a has a sign
    if (discriminant.low() <= 0 || !(a.has_sign() || m_scale == 0)) {
        result.in_doubt = true;
        return is({{}});
    }
    const Ball root = square_root(discriminant);
    const Ball sum = b.middle < 0 ? root - b : -root - b;
    if (!sum.has_sign()) {
        result.in_doubt = true;
        return is({{}});
    }
    const Ball one = c / sum;
    if (m_scale == 0) return is({sum.middle < 0 ? Stretch{{-kInfinity, 0.0}, one} : Stretch{one, {kInfinity, 0.0}}});
    const Ball other = sum / a;
    const bool in_order = (b.middle < 0) == (a.middle > 0);  // also where the two balls overlap
    const Ball first = in_order ? one : other, second = in_order ? other : one;
    if (a.middle > 0) return is({{first, second}});
    return is({{{-kInfinity, 0.0}, first}, {second, {kInfinity, 0.0}}});
}

/// A stretch cut by half-spaces, and what is known of its ends.
struct Clipped {
    double begin_low, begin_high, end_low, end_high;
    double other_begins_high = -kInfinity;  ///< of the surfaces that the stretch does not begin on
    int surface = 0;
    bool in_doubt = false;
};

Clipped clip(const Stretch& stretch, const Solid<double>& solid, const Vector<double>& direction, double reach) {
    Clipped cut{stretch.begin.low(), stretch.begin.high(), stretch.end.low(), stretch.end.high()};
    for (const auto& half_space : solid.half_spaces) {
        const Ball rate = rate_of(half_space.normal, direction, reach);
        if (!rate.has_sign()) {
            cut.in_doubt = true;
            continue;
        }
        const Ball offset{half_space.offset, kRounding * std::abs(half_space.offset)};
        const Ball crossing = -offset / rate;
        if (rate.middle < 0) {
            cut.end_low = std::min(cut.end_low, crossing.low());
            cut.end_high = std::min(cut.end_high, crossing.high());
        } else {
            if (crossing.low() > cut.begin_low) {
                cut.other_begins_high = cut.begin_high;
                cut.begin_low = crossing.low();
                cut.surface = half_space.surface;
            } else {
                cut.other_begins_high = std::max(cut.other_begins_high, crossing.high());
            }
            cut.begin_high = std::max(cut.begin_high, crossing.high());
        }
    }
    return cut;
}

}  // namespace

EntryBounds entry_bounds(const Solid<double>& solid, const Vector<double>& direction, double reach) {
    using Verdict = EntryBounds::Verdict;
    const Stretches stretches = inside_quadric(solid.quadric, direction, reach);
    for (int i = 0; i < stretches.count; ++i) {
        const Clipped cut = clip(stretches.at[i], solid, direction, reach);
        if (cut.begin_low > cut.end_high || cut.end_high <= 0) continue;
        const bool certain = !stretches.in_doubt && !cut.in_doubt && cut.begin_high < cut.end_low && cut.end_low > 0;
        if (certain && cut.begin_high <= kNearDepth) return {Verdict::misses};
        const double least = std::max(cut.begin_low, kNearDepth);
        if (certain && cut.begin_low > kNearDepth && cut.begin_low > cut.other_begins_high)
            return {Verdict::enters, least, cut.begin_high, cut.surface};
        return {Verdict::in_doubt, least};
    }
    return {Verdict::misses};
}

EntryBounds level_plane_bounds(double drop, const Vector<double>& direction, double reach) {
    using Verdict = EntryBounds::Verdict;
    const Ball rate{direction[2], reach + kRounding * length(direction)};
    if (drop == 0) return {Verdict::misses};
    if (!rate.has_sign()) return {Verdict::in_doubt, 0.0};
    const Ball depth = Ball{drop, kRounding * std::abs(drop)} / rate;
    if (depth.middle < 0) return {Verdict::misses};
    return {Verdict::enters, depth.low(), depth.high(), 0};
}

}  // namespace quadrig::reference
