// Distances as numbers that vary in space: of a field, and of a surface that need not enclose anything.
#pragma once

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/mesh/mesh.h"

namespace lamella {

/// A field's value, in whatever unit the field is. Its metric is exact or bound.
GradingPtr make_value_grading(FieldPtr field);

/// The distance to the nearest triangle, 0 or more. InputError for a mesh without triangles.
GradingPtr make_surface_distance_grading(TriangleMesh mesh);

}  // namespace lamella
