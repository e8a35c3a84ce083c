#include "tests/bench/gl_peer/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <variant>
#include <vector>

namespace quadrig::gl_peer {
namespace {

/// q' M q + 2 w.q + c about a solid's anchor.
struct Form {
    Sym3 m;
    glm::dvec3 w{0.0};
    double c = 0.0;
};

Sym3 adjugate(const Sym3& m) {
    return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
            m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.xx * m.yz};
}

/// The ellipsoid {form <= 0}, if it is one: q = -M^-1 w + s with s' M s <= r2.
std::optional<BoundingEllipsoid> ellipsoid_of(const Form& form, const ScenePoint& anchor) {
    const Sym3 adj = adjugate(form.m);
    const double det = form.m.xx * adj.xx + form.m.xy * adj.xy + form.m.xz * adj.xz;
    const double size = std::abs(form.m.xx) + std::abs(form.m.yy) + std::abs(form.m.zz);
    if (!(form.m.xx > 0.0) || !(adj.zz > 0.0) || !(det > 1e-9 * size * size * size)) return std::nullopt;
    const glm::dvec3 centre = (-1.0 / det) * (adj * form.w);
    const double r2 = std::max(0.0, -(form.c + glm::dot(form.w, centre)));
    // A margin of 1e-6 for rounding.
    return BoundingEllipsoid{{anchor.metres + centre}, ((1.0 + 1e-6) * r2 / det) * adj};
}

Form closed(Form form, const SolidPlane& a, const SolidPlane& b, double t) {
    form.m = form.m - (0.5 * t) * outer(a.normal, b.normal);
    form.w -= 0.5 * t * (a.offset * b.normal + b.offset * a.normal);
    form.c -= t * a.offset * b.offset;
    return form;
}

}  // namespace

std::optional<BoundingEllipsoid> bounding_ellipsoid(const Solid& solid, const Shape& shape) {
    const Form form{solid.m, solid.w, solid.c};
    if (solid.ellipsoid) {
        return BoundingEllipsoid{solid.anchor, (-(1.0 + 1e-6) * solid.c / solid.determinant) * solid.adjugate};
    }
    std::vector<SolidPlane> planes = solid.planes;
    if (const auto* hill = std::get_if<Hill>(&shape))
        planes.push_back({{0, 0, -1}, hill->apex.metres.z - solid.anchor.metres.z, 0});
    std::optional<BoundingEllipsoid> best;
    const auto trace = [](const Sym3& m) { return m.xx + m.yy + m.zz; };
    for (std::size_t i = 0; i < planes.size(); ++i) {
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            if (glm::dot(planes[i].normal, planes[j].normal) >= 0.0) continue;
            for (double t = 1.0 / 64; t < 128.0; t *= 1.25) {
                const auto found = ellipsoid_of(closed(form, planes[i], planes[j], t), solid.anchor);
                if (found && (!best || trace(found->spread) < trace(best->spread))) best = found;
            }
        }
    }
    return best;
}

std::optional<Extent> extent_on(const View& view, const BoundingEllipsoid& bounds) {
    const glm::dvec3 c = view.eye_from_scene * (bounds.centre.metres - view.eye.metres);
    const Sym3 s = congruent(bounds.spread, glm::transpose(view.eye_from_scene));
    const ImagePlane& image = view.image;
    const double right = image.x(image.width), bottom = image.z(image.height);
    // Sides of the view, normals inwards.
    for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), glm::dvec3(1, -image.left, 0), glm::dvec3(-1, right, 0),
                                glm::dvec3(0, -bottom, 1), glm::dvec3(0, image.top, -1)})
        if (glm::dot(n, c) < -std::sqrt(std::max(0.0, value(s, n)))) return std::nullopt;
    Extent extent;
    const double front = c.y - std::sqrt(s.yy);
    if (!(front > kNearDepth)) return extent;
    extent.inverse_depth = (1.0 + 1e-5) / front;
    // The plane x = xi y through the eye touches the ellipsoid where (c.x - xi c.y)^2 = S_xx - 2 xi S_xy + xi^2 S_yy.
    const auto range = [&](double at, double spread, double mixed) {
        const double a = c.y * c.y - s.yy, b = at * c.y - mixed;
        const double root = std::sqrt(std::max(0.0, b * b - a * (at * at - spread)));
        return std::pair{(b - root) / a, (b + root) / a};
    };
    const auto [x0, x1] = range(c.x, s.xx, s.xy);
    const auto [z0, z1] = range(c.z, s.zz, s.yz);
    const auto clip = [](double part) { return static_cast<float>(std::clamp(2.0 * part - 1.0, -1.0, 1.0)); };
    extent.left = clip((x0 - image.left) / (right - image.left));
    extent.right = clip((x1 - image.left) / (right - image.left));
    extent.bottom = clip((z0 - bottom) / (image.top - bottom));
    extent.top = clip((z1 - bottom) / (image.top - bottom));
    return extent;
}

}  // namespace quadrig::gl_peer
