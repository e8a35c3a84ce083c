/// The objects of a scene as the shaders read them, for one view.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "ig_core/scene/solid.h"
#include "ig_core/view.h"
#include "tests/bench/gl_peer/bounds.h"

namespace quadrig::gl_peer {

/// Shaders that an object needs.
enum Variant : unsigned { kPlain = 0, kWithPlanes = 1, kGeneral = 2 };
inline constexpr unsigned kVariants = 4;

/// Objects one behind the other in the records, drawn together; a cloud deck is a batch by itself.
struct Batch {
    unsigned variant = kPlain;
    bool deck = false;
    int first = 0, count = 0;
};

/// What the shaders read. A record is kTexels vec4s, eye axes, metres:
///   anchor, c;  M xx yy zz, |Q(centre)|;  M xy xz yz, first plane;  w, number of planes;
///   colour, texture weight;  texture (-1: none), threshold, limb threshold, softness;
///   left, bottom, right, top of what it covers (-1..1);  depth buffer's nearest value, 0, 0, 0
/// Record 0 is the ground. Its anchor, and a cloud deck's, is (0, 0, height of the eye above it). A plane is a vec4 at
/// the eye: n.p + w > 0 is kept.
struct FrameRecords {
    std::vector<float> objects, planes;
    std::vector<Batch> opaque;       ///< front to back in each variant
    std::vector<Batch> translucent;  ///< back to front
};
inline constexpr std::size_t kTexels = 8;

/// Transforms, culls and sorts in double precision. Keeps its memory from view to view.
class FrameObjects {
  public:
    /// The scene stands still, and stays where it is as long as this does.
    explicit FrameObjects(const Scene& scene);
    /// Objects in front of others are those whose centres are nearer in depth; decks lie between the objects that
    /// are on the eye's side of them and the others.
    const FrameRecords& look(const View& view);

  private:
    struct Drawable {
        Solid solid;
        std::optional<BoundingEllipsoid> bounds;
        std::vector<glm::dvec3> corners;  ///< of a polytope about it; none for ellipsoids
        const Paint* paint = nullptr;
        unsigned variant = kPlain;
        bool translucent = false;
    };
    struct Seen {
        std::size_t drawable;
        Extent extent;
        double depth;
        int decks_before;  ///< cloud decks between it and the eye
    };
    void add_record(const View& view, const Seen& seen);
    void add_paint(const Paint& paint);
    void add_plane(const View& view, double altitude, const Paint& paint);
    void add_batches(const View& view);

    const Scene& scene_;
    std::vector<Drawable> drawables_;
    std::vector<Seen> opaque_, translucent_;
    FrameRecords records_;
};

}  // namespace quadrig::gl_peer
