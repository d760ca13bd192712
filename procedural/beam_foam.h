// BeamFoam: what all foams of beams share as fields: distances, ranges and slices from a query of beams.
#pragma once

#include <vector>

#include "engine/beam.h"
#include "engine/field.h"
#include "engine/grading.h"
#include "procedural/cell_cache.h"
#include "procedural/distance_brick.h"

namespace lamella {

/// The union of infinitely many beams, known by what touches a box.
class BeamFoam : public Field {
  public:
    /// Every beam whose solid touches the box, once, in canonical order.
    virtual std::vector<Beam> beams_touching(const Box& box) const = 0;

    /// The minimum of the signed distances to all beams, mm: the exact distance outside; inside, its
    /// magnitude never exceeds the distance to the surface. NaN at points that are not finite.
    double value(dvec3 p) const override;
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override;
    /// The region.
    Box bounds() const override { return region_; }

    /// The beams that meet the region's rectangle at height z, in canonical order.
    std::vector<Beam> beams_at(double z) const;

  protected:
    /// `cell`: about how far beams are apart, mm, within `cells` everywhere. No beam is thicker than
    /// `largest_radius`, mm. `cache_bytes` bounds the memory for distances.
    BeamFoam(const Box& region, GradingPtr cell, Interval cells, double largest_radius,
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
    mutable CellCache<DistanceBrick> bricks_;
};

}  // namespace lamella
