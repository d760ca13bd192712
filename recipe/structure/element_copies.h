// Elements as meshes and copies, for programs that read 3MF.
#pragma once

#include <vector>

#include "printers/vector/component_package.h"
#include "procedural/elements/element_plan.h"
#include "recipe/build/build_gradings.h"

namespace lamella {

struct ElementCopies {
    std::vector<TriangleMesh> meshes;
    std::vector<MeshCopy> copies;
};

/// Returns the meshes of the recipe's shapes and the copies of a plan, bridges included; in a plate they are
/// prisms between `heights`, mm. The body does not cut them. Throws InputError for elements of a skin, which
/// bend, and for shapes of fields, which are no meshes.
ElementCopies element_copies(const Recipe& recipe, const ElementPlan& plan, Interval heights);

}  // namespace lamella
