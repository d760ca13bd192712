// ClosedFoam: the foam whose cells are closed by walls, wholly or but for a window in each.
#pragma once

#include <memory>
#include <vector>

#include "engine/field.h"
#include "procedural/cell_units.h"
#include "procedural/distance_brick.h"
#include "procedural/foam_settings.h"
#include "procedural/foam_walls.h"
#include "procedural/plane_strips.h"

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
class ClosedFoam : public Field {
  public:
    /// Throws InputError for settings out of range.
    explicit ClosedFoam(const ClosedFoamSettings& settings);

    /// The minimum of the signed distances to all beams and walls, mm: the exact distance outside; inside,
    /// its magnitude never exceeds the distance to the surface. NaN at points that are not finite.
    double value(dvec3 p) const override;
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    /// The foam with beams and walls thicker by d on every side, d >= 0; null for d < 0, where the joints
    /// have no closed form.
    FieldPtr offset(double d) const override;
    const SliceField& slice(SliceContext& context, double z) const override;
    /// The region.
    Box bounds() const override { return region_; }

    /// Every piece whose solid touches the box, once, in canonical order.
    std::vector<FoamPiece> pieces_touching(const Box& box) const { return units_->touching(box); }

  private:
    struct BrickSize {
        int level;    ///< halvings of the largest cell
        double side;  ///< mm
    };
    ClosedFoam(const ClosedFoamSettings& settings, const FoamGround& ground);
    ClosedFoam(const ClosedFoam& foam, double growth);
    BrickSize brick_size(dvec3 p) const;
    PlanePieces plane_pieces(const Box& box) const;

    Box region_;
    FoamGround ground_;
    WallSettings walls_;
    Stretch stretch_;
    std::size_t cache_bytes_;
    std::shared_ptr<const CellUnits<WallMaker>> units_;
    mutable CellCache<PieceBrick<FoamPiece>> bricks_;
};

/// Throws InputError for settings out of range.
std::shared_ptr<const ClosedFoam> make_closed_foam(const ClosedFoamSettings& settings);

}  // namespace lamella
