#include "ig_core/outline/polyline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace quadrig {
namespace {

/// Chords to begin with, so that no wave falls between two of them, and how often each may be halved.
constexpr int kFirstChords = 8;
constexpr int kMostHalvings = 14;
/// Of the tolerance: how closely in z the begin or end of a gap is found.
constexpr double kClosest = 1e-3;

bool is_point(const glm::dvec2& p) { return std::isfinite(p.x); }

double distance_from_chord(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * along);
}

/// The points of one z interval, by a parameter in which the square root at either end is smooth: z = mid - half cos t.
class Follower {
  public:
    Follower(double z_from, double z_to, const std::function<double(double)>& x_at, const ImageWindow& window,
             double tolerance)
        : z_from_(z_from), z_to_(z_to), x_at_(x_at), window_(window), tolerance_(tolerance) {}

    std::vector<Polyline> run() {
        glm::dvec2 last = at(0.0);
        append(last);
        for (int i = 1; i <= kFirstChords; ++i) {
            const double from = (i - 1.0) / kFirstChords, to = static_cast<double>(i) / kFirstChords;
            const glm::dvec2 next = at(to);
            refine(from, last, to, next, 0);
            append(next);
            last = next;
        }
        std::erase_if(pieces_, [](const Polyline& piece) { return piece.size() < 2; });
        return std::move(pieces_);
    }

  private:
    glm::dvec2 at(double part) const {
        const double rise = std::sin(0.5 * std::numbers::pi * part);
        const double z = part < 1.0 ? z_from_ + (z_to_ - z_from_) * rise * rise : z_to_;
        return {x_at_(z), z};
    }

    void append(const glm::dvec2& p) {
        if (!is_point(p))
            open_ = false;
        else if (std::exchange(open_, true))
            pieces_.back().push_back(p);
        else
            pieces_.push_back({p});
    }

    void refine(double from, const glm::dvec2& a, double to, const glm::dvec2& b, int halvings) {
        if (halvings == kMostHalvings) return;
        const double middle = 0.5 * (from + to);
        const glm::dvec2 p = at(middle);
        if (!needed(a, p, b)) return;
        refine(from, a, middle, p, halvings + 1);
        append(p);
        refine(middle, p, to, b, halvings + 1);
    }

    [[nodiscard]] bool needed(const glm::dvec2& a, const glm::dvec2& p, const glm::dvec2& b) const {
        const int points = is_point(a) + is_point(p) + is_point(b);
        if (points < 3) return points > 0 && b.y - a.y > kClosest * tolerance_;
        // An arc that bends one way strays beyond a, p and b by less than four times what p strays from their chord:
        // two times if z were halved by p, more near an end.
        const double astray = 4.0 * std::abs(p.x - std::lerp(a.x, b.x, (p.y - a.y) / (b.y - a.y)));
        const double left = std::min({a.x, p.x, b.x}) - astray, right = std::max({a.x, p.x, b.x}) + astray;
        return left <= window_.x_to && right >= window_.x_from &&
               2.0 * distance_from_chord(p, a, b) > tolerance_;  // not all stray most in the middle
    }

    double z_from_, z_to_;
    const std::function<double(double)>& x_at_;
    const ImageWindow& window_;
    double tolerance_;
    std::vector<Polyline> pieces_;
    bool open_ = false;
};

/// The part of a chord inside the window, as parameters 0..1 along it (Liang and Barsky 1984); from > to: none.
struct Inside {
    double from = 0.0, to = 1.0;
};
Inside inside_window(const glm::dvec2& a, const glm::dvec2& b, const ImageWindow& window) {
    Inside in;
    const auto keep = [&in](double slope, double here) {  // here + t slope >= 0
        if (slope > 0.0)
            in.from = std::max(in.from, -here / slope);
        else if (slope < 0.0)
            in.to = std::min(in.to, -here / slope);
        else if (here < 0.0)
            in.to = -1.0;
    };
    keep(b.x - a.x, a.x - window.x_from);
    keep(a.x - b.x, window.x_to - a.x);
    keep(b.y - a.y, a.y - window.z_from);
    keep(a.y - b.y, window.z_to - a.y);
    return in;
}

}  // namespace

std::vector<Polyline> follow(double z_from, double z_to, const std::function<double(double)>& x_at,
                             const ImageWindow& window, double tolerance) {
    return Follower(z_from, z_to, x_at, window, tolerance).run();
}

double distance(const glm::dvec2& p, const Polyline& path) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < path.size(); ++i)
        nearest = std::min(nearest, distance_from_chord(p, path[i - 1], path[i]));
    return nearest;
}

std::vector<Polyline> clip(const Polyline& path, const ImageWindow& window) {
    std::vector<Polyline> pieces;
    bool open = false;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const glm::dvec2 &a = path[i - 1], &b = path[i];
        const Inside in = inside_window(a, b, window);
        if (!(in.from < in.to)) {
            open = false;
            continue;
        }
        if (!open) pieces.push_back({in.from > 0.0 ? a + in.from * (b - a) : a});
        open = in.to >= 1.0;
        pieces.back().push_back(open ? b : a + in.to * (b - a));
    }
    return pieces;
}

std::vector<Polyline> line_across(const glm::dvec3& a, const ImageWindow& window) {
    const double length = std::hypot(a.x, a.z);
    const glm::dvec2 middle(0.5 * (window.x_from + window.x_to), 0.5 * (window.z_from + window.z_to));
    const double distance = (a.x * middle.x + a.y + a.z * middle.y) / length;
    const double reach = std::hypot(window.width(), window.height());
    if (!(std::abs(distance) < reach)) return {};
    const glm::dvec2 normal(a.x / length, a.z / length), along(-normal.y, normal.x);
    const glm::dvec2 foot = middle - distance * normal;
    return clip({foot - reach * along, foot + reach * along}, window);
}

}  // namespace quadrig
