// Fields, gradings and meshes of the embedding program.
#pragma once

#include "bindings/lamella.h"
#include "recipe/recipe.h"

namespace lamella {

/// The solid of a program's function. Throws BadCall for what no field should have.
HostGiven<FieldPtr> host_field(const lamella_field& field, const std::string& name);

/// The number of a program's function. Throws BadCall for what no grading should have.
HostGiven<GradingPtr> host_grading(const lamella_grading& grading, const std::string& name);

/// The solid of a program's mesh, closed and mended. Throws BadCall for corners that there are none of,
/// InputError for what encloses nothing.
HostGiven<FieldPtr> host_mesh(const lamella_mesh& mesh, const std::string& name);

}  // namespace lamella
