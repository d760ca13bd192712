// PieceFoam: what all foams share as fields: distances, ranges and slices from a query of their pieces.
#pragma once

#include <vector>

#include "engine/field.h"
#include "engine/grading.h"
#include "procedural/cell_cache.h"
#include "procedural/distance_brick.h"
#include "procedural/foam_piece.h"

namespace lamella {

/// The union of infinitely many pieces, known by what touches a box. Piece: Beam or FoamPiece.
template <typename Piece>
class PieceFoam : public Field {
  public:
    /// Every piece whose solid touches the box, once, in canonical order.
    virtual std::vector<Piece> pieces_touching(const Box& box) const = 0;

    /// The minimum of the signed distances to all pieces, mm: the exact distance outside; inside, its
    /// magnitude never exceeds the distance to the surface. NaN at points that are not finite.
    double value(dvec3 p) const override;
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override;
    /// The region.
    Box bounds() const override { return region_; }

  protected:
    /// `cell`: about how far pieces are apart, mm, within `cells` everywhere. No piece is thicker than
    /// `largest_radius`, mm. `cache_bytes` bounds the memory for distances.
    PieceFoam(const Box& region, GradingPtr cell, Interval cells, double largest_radius,
              std::size_t cache_bytes)
        : region_(region),
          cell_(std::move(cell)),
          cells_(cells),
          largest_radius_(largest_radius),
          bricks_(cache_bytes) {}

  private:
    struct BrickSize {
        int level;    ///< halvings of the largest cell
        double side;  ///< mm
    };
    BrickSize brick_size(dvec3 p) const;

    Box region_;
    GradingPtr cell_;
    Interval cells_;
    double largest_radius_;
    mutable CellCache<PieceBrick<Piece>> bricks_;
};

extern template class PieceFoam<Beam>;
extern template class PieceFoam<FoamPiece>;

}  // namespace lamella
