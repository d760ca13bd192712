// Constructive solid geometry: set operations, offsets and affine maps of solids.
#pragma once

#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Set operations. Runs are merged exactly; values are min and max, with metric `bound` if all operands are
/// bound or exact. Throw InputError when the list is empty.
FieldPtr make_union(std::vector<FieldPtr> solids);
FieldPtr make_intersection(std::vector<FieldPtr> solids);
FieldPtr make_difference(FieldPtr from, FieldPtr taken);

/// Returns the solid dilated (d > 0) or eroded (d < 0) by |d| mm in 3D: in closed form where the solid has
/// one, else by shifting the value if the metric is exact. Throws InputError when neither is possible.
FieldPtr make_offset(FieldPtr solid, double d);

/// Returns the union with a rounded seam: the polynomial smooth minimum with blending radius `radius`, mm. It
/// differs from the union only outside both, where neither value exceeds the radius; there a fillet leaves
/// the two surfaces `radius` away from their corner. Runs are the operands' own; only the seam around `b` is
/// sampled.
FieldPtr make_smooth_union(FieldPtr a, FieldPtr b, double radius);

/// Returns `from` without `taken`, with rounded edges: the smooth minimum of the outside of `from` and of
/// `taken` is removed. The result lacks more than the plain difference only within `radius` of both surfaces;
/// elsewhere runs are `from`'s own.
FieldPtr make_smooth_difference(FieldPtr from, FieldPtr taken, double radius);

/// Returns the solid under the map p -> linear p + translation. Axis-aligned scales and mirrors keep
/// closed-form runs; under any other map the solid is sampled. Throws InputError when the linear part is
/// singular.
FieldPtr make_transform(FieldPtr solid, const glm::dmat3& linear, dvec3 translation);

}  // namespace lamella
