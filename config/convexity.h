/// Whether {Q <= 0} within some half-spaces is one convex piece: what an object has to be (ig_core/README.md).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ig_core/scene/scene.h"

namespace quadrig::config {

/// The reason why the solid cannot be one convex piece; nothing where it is, or where it is too close to call.
///
/// By the signs of the quadratic part's eigenvalues (relative tolerance 1e-10): none negative is convex; one negative
/// with a value of at least 0 at the centre is two convex sheets, of which the planes have to leave one at most; the
/// rest is not convex, except where Q is nowhere positive. Only what certainly has two pieces, or a hollow side, is
/// given a reason.
std::optional<std::string> why_not_convex(const GeneralQuadric& quadric, std::span<const BoundingPlane> planes);

}  // namespace quadrig::config
