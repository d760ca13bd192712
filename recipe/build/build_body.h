// Makes a recipe's body: a mesh, a shape or a field.
#pragma once

#include <optional>

#include "recipe/build/build_fields.h"

namespace lamella {

/// Makes the body of the part, without foam and skin, turned about the origin by orthogonal axes. A mesh
/// fills in the report. Throws InputError when a file cannot be read or the body is empty.
FieldPtr build_body(const Recipe& recipe, Gradings& gradings, std::optional<MeshReport>& report,
                    const glm::dmat3& axes = glm::dmat3(1));

}  // namespace lamella
