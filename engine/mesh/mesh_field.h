// A mesh as a field: distance by a tree of triangles, sections by winding number, offsets by grown triangles.
#pragma once

#include "engine/field/field.h"
#include "engine/mesh/mesh_repair.h"

namespace lamella {

/// The solid that a closed mesh encloses: all points with a winding number other than 0.
FieldPtr make_mesh_field(SolidMesh mesh);

}  // namespace lamella
