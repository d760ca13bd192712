// Distances as gradings: to a solid, or to a surface that need not be closed.
#pragma once

#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/mesh/mesh.h"

namespace lamella {

/// Returns a field's value as a grading, in the field's own unit. The field's metric must be exact or bound.
GradingPtr make_value_grading(FieldPtr field);

/// Returns the unsigned distance to the nearest triangle. Throws InputError for a mesh without triangles.
GradingPtr make_surface_distance_grading(TriangleMesh mesh);

}  // namespace lamella
