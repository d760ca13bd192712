// ClosedFoam: the foam whose cells are closed by walls, wholly or but for a window in each.
#pragma once

#include <memory>
#include <vector>

#include "procedural/foam/cell_units.h"
#include "procedural/foam/foam_settings.h"
#include "procedural/foam/foam_walls.h"
#include "procedural/foam/piece_foam.h"

namespace lamella {

/// What a foam with walls is made of.
struct ClosedFoamSettings {
    FoamSettings foam;  ///< the cells, and the beams along their edges
    /// Thickness of the walls, mm, >= 0, asked for at the nodes and in the middle of each face; at most 0.9
    /// of the local cell. Where it is 0 there is none.
    Graded wall = 0.2;
    /// Share of a wall's width that is a window, asked for in the middle of each face: 0 is closed, 1 has no
    /// wall; graded numbers beyond count as these.
    Graded window = 0.0;
};

/// The foam of all faces of the Voronoi diagram that VoronoiFoam takes the edges of: every face is a wall,
/// its rims round, with a window in its middle where one is asked for; beams run along the edges. It fills
/// space; the region only says where slices and bounds are wanted.
class ClosedFoam : public PieceFoam<FoamPiece> {
  public:
    /// Throws InputError for settings out of range.
    explicit ClosedFoam(const ClosedFoamSettings& settings);

    std::vector<FoamPiece> pieces_touching(const Box& box) const override { return units_.touching(box); }
    /// The foam with beams and walls thicker by d on every side, d >= 0; null for d < 0, where the joints
    /// have no closed form.
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
