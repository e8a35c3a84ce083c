/// The forms of the image as the paper writes them (Gardner 1984, Eq 4 to 14), straight from eye coordinates: L = v v'
/// - s M, E = b^2 M - b (v n' + n v') + s n n' and the like are differences of products that may be far larger than the
/// result. Nothing but a comparison needs them: image_forms.h is what they are compared with.
#pragma once

#include "ig_core/outline/image_forms.h"

namespace quadrig {

/// Replaces what look_at() found by the paper's formulas, each number rounded to `Real`. `solid` has to be looked at
/// without shear (x0 = z0 = 0). Instantiated for float and double.
template <class Real>
void set_textbook_forms(EyeSolid& solid);

template <class Real>
RowConic textbook_limb_on_rows(const EyeSolid& solid);
template <class Real>
RowConic textbook_intersection_curve_on_rows(const EyeSolid& solid, const EyePlane& plane);
template <class Real>
glm::dvec3 textbook_visibility_line(const EyeSolid& solid, const EyePlane& plane);
template <class Real>
glm::dvec3 textbook_intersection_line(const EyePlane& i, const EyePlane& j);

}  // namespace quadrig
