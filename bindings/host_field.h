// Fields, gradings and meshes that an embedding program gives to a recipe.
#pragma once

#include "bindings/lamella.h"
#include "recipe/recipe.h"

namespace lamella {

/// Makes a field from a program's function. Throws BadCall for a missing function or identity, an invalid box
/// and an unknown metric.
HostGiven<FieldPtr> host_field(const lamella_field& field, const std::string& name);

/// Makes a grading from a program's function. Throws BadCall for a missing function or identity and an
/// invalid range.
HostGiven<GradingPtr> host_grading(const lamella_grading& grading, const std::string& name);

/// Makes a field from a program's mesh, closed and mended. Throws BadCall for vertices that are not finite or
/// triangles with vertices that do not exist, InputError for a mesh that encloses nothing.
HostGiven<FieldPtr> host_mesh(const lamella_mesh& mesh, const std::string& name);

}  // namespace lamella
