// A mesh as a field: distance from a tree of triangles, sections by winding number, offsets by round
// triangles.
#pragma once

#include "engine/field/field.h"
#include "engine/mesh/mesh_repair.h"

namespace lamella {

/// Returns the solid that a closed mesh encloses: all points with a winding number other than 0.
FieldPtr make_mesh_field(SolidMesh mesh);

}  // namespace lamella
