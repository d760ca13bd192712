// ClosedFoam: the closed-cell foam, whose Voronoi faces are walls, each with or without a window.
#pragma once

#include <memory>
#include <vector>

#include "procedural/foam/cell_units.h"
#include "procedural/foam/foam_settings.h"
#include "procedural/foam/foam_walls.h"
#include "procedural/foam/piece_foam.h"

namespace lamella {

/// Parameters of a foam with walls.
struct ClosedFoamSettings {
    FoamSettings foam;  ///< the cells, and the beams along their edges
    /// Thickness of the walls, mm, >= 0, at most 0.9 of the local cell. Sampled at the nodes and at the
    /// centre of each face. Where it is 0 there is no wall.
    Graded wall = 0.2;
    /// Size of the windows, as a share of a wall's width: 0 is closed, 1 has no wall. Sampled at the centre
    /// of each face; graded numbers are clamped to [0, 1].
    Graded window = 0.0;
};

/// A foam on the same Voronoi diagram as VoronoiFoam. Every face of the diagram is a wall with round rims,
/// with a window in its centre if wanted; beams run along the edges. The foam fills space; `region` only
/// bounds slices.
class ClosedFoam : public PieceFoam<FoamPiece> {
  public:
    /// Throws InputError for settings out of range.
    explicit ClosedFoam(const ClosedFoamSettings& settings);

    std::vector<FoamPiece> pieces_touching(const Box& box) const override { return units_.touching(box); }
    /// Returns the foam with beams and walls thicker by d on every side, d >= 0; null for d < 0, where the
    /// joints have no closed form.
    FieldPtr offset(double d) const override;

  private:
    ClosedFoam(const ClosedFoamSettings& settings, const FoamSeeding& ground);
    ClosedFoam(const Box& region, const FoamSeeding& ground, const WallSettings& walls,
               std::size_t cache_bytes);

    FoamSeeding ground_;
    WallSettings walls_;
    std::size_t cache_bytes_;
    CellUnits<FramedMaker<WallMaker>> units_;
};

/// Throws InputError for settings out of range.
std::shared_ptr<const ClosedFoam> make_closed_foam(const ClosedFoamSettings& settings);

}  // namespace lamella
