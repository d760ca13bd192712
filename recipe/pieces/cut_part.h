// Cuts a part into pieces by planes, with pins or holes by which they are joined again.
#pragma once

#include <span>
#include <vector>

#include "engine/field/field.h"
#include "recipe/pieces/cut_recipe.h"
#include "recipe/pieces/joint_places.h"

namespace lamella {

/// One piece: for each cut, whether it lies above the plane, where the normal points.
using PieceSides = std::vector<bool>;

/// Returns the plane of a cut of a part that was turned about the origin by orthogonal axes.
CutPlane plane_of(const CutRecipe& cut, const glm::dmat3& axes);

/// Returns the pieces that planes cut a solid into: those that are not empty, lowest first along the first
/// plane's normal, then the second's and so on. What lies on the same sides of all planes is one piece, even
/// if it is not connected. Throws InputError, naming the cut, for a plane that divides nothing.
std::vector<PieceSides> pieces_of(const FieldPtr& solid, std::span<const CutRecipe> cuts,
                                  std::span<const CutPlane> planes);

/// Cuts fields of one part to a piece of it.
class CutPiece {
  public:
    /// One of the pieces that the planes make. `outer` is the part within its outer surface: joints with the
    /// piece's neighbours are placed in it. Throws InputError where there is no room for them.
    CutPiece(std::span<const CutRecipe> cuts, std::span<const CutPlane> planes,
             std::span<const PieceSides> pieces, std::size_t piece, const FieldPtr& outer);

    /// Returns the piece of a part, with solid faces along the cuts, pins, and walls around holes.
    FieldPtr of(const FieldPtr& part) const;

  private:
    FieldPtr space_;                ///< on the piece's sides of all planes
    std::vector<FieldPtr> solids_;  ///< to add before the part is cut; within `outer`
    std::vector<FieldPtr> pins_;    ///< to add after that
    std::vector<FieldPtr> holes_;   ///< to remove at last
};

}  // namespace lamella
