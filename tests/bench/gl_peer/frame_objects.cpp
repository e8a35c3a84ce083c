#include "tests/bench/gl_peer/frame_objects.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "tests/bench/gl_peer/polytope.h"

namespace quadrig::gl_peer {
namespace {

void append(std::vector<float>& out, std::initializer_list<double> values) {
    for (const double value : values) out.push_back(static_cast<float>(value));
}

/// Whether the plane Z = altitude lies between two heights.
bool between(double altitude, double one, double other) { return (one < altitude) != (other < altitude); }

void extend(std::vector<Batch>& batches, unsigned variant, int object) {
    if (!batches.empty() && !batches.back().deck && batches.back().variant == variant)
        ++batches.back().count;
    else
        batches.push_back({variant, false, object, 1});
}

}  // namespace

FrameObjects::FrameObjects(const Scene& scene) : scene_(scene) {
    for (const Object& object : scene.objects) {
        Drawable drawable{make_solid(object), {}, {}, &object.paint, kPlain, false};
        drawable.bounds = bounding_ellipsoid(drawable.solid, object.shape);
        if (drawable.bounds && !drawable.solid.ellipsoid)
            drawable.corners = polytope_about(drawable.solid, object.shape, *drawable.bounds);
        drawable.variant =
            (drawable.solid.planes.empty() ? kPlain : kWithPlanes) | (drawable.solid.ellipsoid ? kPlain : kGeneral);
        drawable.translucent = object.paint.texture && object.paint.translucence;
        drawables_.push_back(std::move(drawable));
    }
}

const FrameRecords& FrameObjects::look(const View& view) {
    opaque_.clear(), translucent_.clear();
    for (std::size_t i = 0; i < drawables_.size(); ++i) {
        const Drawable& drawable = drawables_[i];
        Seen seen{i, {}, 0.0, 0};
        if (drawable.bounds) {
            auto extent = extent_on(view, *drawable.bounds);
            if (extent && !drawable.corners.empty())
                extent = narrowed(*extent, view, drawable.solid.anchor, drawable.corners);
            if (!extent) continue;
            seen.extent = *extent;
        }
        const glm::dvec3& centre = (drawable.bounds ? drawable.bounds->centre : drawable.solid.anchor).metres;
        seen.depth = glm::dot(glm::transpose(view.eye_from_scene)[1], centre - view.eye.metres);
        for (const CloudDeck& deck : scene_.cloud_decks)
            seen.decks_before += between(deck.altitude, view.eye.metres.z, centre.z) ? 1 : 0;
        (drawable.translucent ? translucent_ : opaque_).push_back(seen);
    }
    std::sort(opaque_.begin(), opaque_.end(), [&](const Seen& a, const Seen& b) {
        return std::tuple(drawables_[a.drawable].variant, a.depth, a.drawable) <
               std::tuple(drawables_[b.drawable].variant, b.depth, b.drawable);
    });
    std::sort(translucent_.begin(), translucent_.end(), [](const Seen& a, const Seen& b) {
        return std::tuple(b.decks_before, b.depth, b.drawable) < std::tuple(a.decks_before, a.depth, a.drawable);
    });
    add_batches(view);
    return records_;
}

void FrameObjects::add_batches(const View& view) {
    records_.objects.clear(), records_.planes.clear(), records_.opaque.clear(), records_.translucent.clear();
    add_plane(view, 0.0, scene_.ground ? scene_.ground->paint : Paint{});
    int record = 1;
    for (const Seen& seen : opaque_) {
        add_record(view, seen);
        extend(records_.opaque, drawables_[seen.drawable].variant, record++);
    }
    // Decks by distance: `before` counts those nearer than one.
    std::vector<const CloudDeck*> decks;
    for (const CloudDeck& deck : scene_.cloud_decks) decks.push_back(&deck);
    const auto away = [&](const CloudDeck* deck) { return std::abs(deck->altitude - view.eye.metres.z); };
    std::stable_sort(decks.begin(), decks.end(), [&](const auto* a, const auto* b) { return away(a) > away(b); });
    auto seen = translucent_.begin();
    const auto draw_objects_behind = [&](int decks_before) {
        for (; seen != translucent_.end() && seen->decks_before >= decks_before; ++seen) {
            add_record(view, *seen);
            extend(records_.translucent, drawables_[seen->drawable].variant, record++);
        }
    };
    for (std::size_t i = 0; i < decks.size(); ++i) {
        const bool above = decks[i]->altitude >= view.eye.metres.z;
        const auto nearer = std::count_if(decks.begin() + static_cast<std::ptrdiff_t>(i) + 1, decks.end(),
                                          [&](const auto* d) { return (d->altitude >= view.eye.metres.z) == above; });
        draw_objects_behind(static_cast<int>(nearer) + 1);
        add_plane(view, decks[i]->altitude, decks[i]->paint);
        records_.translucent.push_back({kPlain, true, record++, 1});
    }
    draw_objects_behind(0);
}

void FrameObjects::add_paint(const Paint& paint) {
    append(records_.objects, {paint.colour.x, paint.colour.y, paint.colour.z, paint.texture_weight});
    const Translucence holes = paint.translucence.value_or(Translucence{-2.0, -2.0, 1.0});
    append(records_.objects, {paint.texture ? static_cast<double>(*paint.texture) : -1.0, holes.threshold,
                              holes.limb_threshold, holes.softness});
}

void FrameObjects::add_plane(const View& view, double altitude, const Paint& paint) {
    append(records_.objects, {0, 0, view.eye.metres.z - altitude, 0});
    records_.objects.insert(records_.objects.end(), 12, 0.0F);
    add_paint(paint);
    records_.objects.insert(records_.objects.end(), 8, 0.0F);
}

void FrameObjects::add_record(const View& view, const Seen& seen) {
    const Drawable& drawable = drawables_[seen.drawable];
    const Solid& solid = drawable.solid;
    const glm::dmat3& turn = view.eye_from_scene;
    const glm::dvec3 from_eye = solid.anchor.metres - view.eye.metres, anchor = turn * from_eye, w = turn * solid.w;
    const Sym3 m = congruent(solid.m, glm::transpose(turn));
    std::vector<float>& out = records_.objects;
    append(out, {anchor.x, anchor.y, anchor.z, solid.c});
    append(out, {m.xx, m.yy, m.zz, solid.centre_value});
    append(out, {m.xy, m.xz, m.yz, static_cast<double>(records_.planes.size() / 4)});
    append(out, {w.x, w.y, w.z, static_cast<double>(solid.planes.size())});
    add_paint(*drawable.paint);
    const Extent& e = seen.extent;
    out.insert(out.end(), {e.left, e.bottom, e.right, e.top});
    append(out, {kNearDepth * e.inverse_depth, 0, 0, 0});
    for (const SolidPlane& plane : solid.planes) {
        const glm::dvec3 normal = turn * plane.normal;
        append(records_.planes, {normal.x, normal.y, normal.z, plane.offset - glm::dot(plane.normal, from_eye)});
    }
}

}  // namespace quadrig::gl_peer
