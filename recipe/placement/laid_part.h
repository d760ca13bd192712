// LaidPart: a recipe's part as a solid body, laid on the bed in many ways.
#pragma once

#include <optional>

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "engine/mesh/mesh_repair.h"
#include "recipe/recipe.h"

namespace lamella {

/// Makes the body of a part in any orientation and plans its supports, on bridges if the recipe says so. A
/// mesh is read once. Calls may come from several threads.
class LaidPart {
  public:
    /// Takes a recipe with known placement, see with_known_placement(). Throws InputError for a mesh that
    /// cannot be read.
    explicit LaidPart(const Recipe& recipe);

    /// Returns the solid body with this direction of the part down. Throws InputError when it cannot be made.
    FieldPtr body(dvec3 lay_on) const;

    /// Returns the material of the supports that are planned for that body, mm^3, with `threads` threads (0:
    /// one per core). Throws InputError when the body cannot be made, Interrupted when cancelled.
    double support_volume(dvec3 lay_on, int threads, const CancelToken* cancel) const;

  private:
    Recipe recipe_;                  ///< without foam, skin, regions and turns
    std::optional<SolidMesh> mesh_;  ///< mirrored and scaled, not turned
};

}  // namespace lamella
