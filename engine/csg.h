// Constructive solid geometry: solids made of solids, and moved solids.
#pragma once

#include <vector>

#include "engine/field.h"

namespace lamella {

/// Set operations. Spans are merged exactly; values are min and max, whose metric is `bound` when the
/// operands' is bound or exact. An empty list is an InputError.
FieldPtr make_union(std::vector<FieldPtr> solids);
FieldPtr make_intersection(std::vector<FieldPtr> solids);
FieldPtr make_difference(FieldPtr from, FieldPtr taken);

/// The solid grown or shrunk by d mm in 3D: in closed form where the solid has one, by shifting the value
/// where the metric is exact; InputError where neither holds.
FieldPtr make_offset(FieldPtr solid, double d);

/// Union with a rounded seam: the polynomial smooth minimum with blending radius `radius`, mm.
FieldPtr make_smooth_union(FieldPtr a, FieldPtr b, double radius);

/// The solid under the map p -> linear p + translation. Axis-aligned scales and mirrors keep closed-form
/// spans; any other map is sampled. InputError when the linear part is singular.
FieldPtr make_transform(FieldPtr solid, const glm::dmat3& linear, dvec3 translation);

}  // namespace lamella
