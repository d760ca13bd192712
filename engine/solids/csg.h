// Constructive solid geometry: solids made of solids, and moved solids.
#pragma once

#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// Set operations. Spans are merged exactly; values are min and max, whose metric is `bound` when the
/// operands' is bound or exact. An empty list is an InputError.
FieldPtr make_union(std::vector<FieldPtr> solids);
FieldPtr make_intersection(std::vector<FieldPtr> solids);
FieldPtr make_difference(FieldPtr from, FieldPtr taken);

/// The solid grown or shrunk by d mm in 3D: in closed form where the solid has one, by shifting the value
/// where the metric is exact; InputError where neither holds.
FieldPtr make_offset(FieldPtr solid, double d);

/// Union with a rounded seam: the polynomial smooth minimum with blending radius `radius`, mm. It differs
/// from the union only outside both, where neither value exceeds the radius; there a fillet leaves the two
/// surfaces `radius` away from their corner. Runs are the operands' own; only the seam about `b` is sampled.
FieldPtr make_smooth_union(FieldPtr a, FieldPtr b, double radius);

/// `from` less `taken` with rounded edges: the same smooth minimum of what is outside `from` and what is
/// taken. It lacks more than the difference only within `radius` of both surfaces; elsewhere runs are
/// `from`'s own.
FieldPtr make_smooth_difference(FieldPtr from, FieldPtr taken, double radius);

/// The solid under the map p -> linear p + translation. Axis-aligned scales and mirrors keep closed-form
/// spans; any other map is sampled. InputError when the linear part is singular.
FieldPtr make_transform(FieldPtr solid, const glm::dmat3& linear, dvec3 translation);

}  // namespace lamella
