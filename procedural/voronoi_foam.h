// VoronoiFoam: the open-cell foam whose beams run along the edges of a Voronoi diagram.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/beam.h"
#include "engine/field.h"
#include "procedural/cell_units.h"
#include "procedural/distance_brick.h"
#include "procedural/foam_settings.h"

namespace lamella {

/// The Voronoi foam of Martinez, Dumas and Lefebvre (SIGGRAPH 2016), made exact: the union of round beams
/// along all edges of the Voronoi diagram of jittered seeds, its cell size and beam radius graded. It fills
/// space; the region only says where slices and bounds are wanted.
class VoronoiFoam : public Field {
  public:
    /// Throws InputError for settings out of range.
    explicit VoronoiFoam(const FoamSettings& settings);

    /// The minimum of the signed distances to all beams, mm: the exact distance outside; inside, its
    /// magnitude never exceeds the distance to the surface. NaN at points that are not finite.
    double value(dvec3 p) const override;
    Interval range(const Box& box) const override;
    Metric metric() const override { return Metric::bound; }
    /// The foam with beams of radius + d, d >= 0; null for d < 0, where the joints have no closed form.
    FieldPtr offset(double d) const override;
    const SliceField& slice(SliceContext& context, double z) const override;
    /// The region.
    Box bounds() const override { return settings_.region; }

    const FoamSettings& settings() const { return settings_; }
    /// The cell sizes of the region, mm.
    Interval cells() const { return ground_.cells; }
    /// All seeds in the closed box, by key.
    std::vector<Seed> seeds_in(const Box& box) const;
    /// Every beam whose solid touches the box, once, in canonical order.
    std::vector<Beam> beams_touching(const Box& box) const { return units_->touching(box); }
    /// The beams that meet the region's rectangle at height z, in canonical order.
    std::vector<Beam> beams_at(double z) const;
    /// The share of space that is solid about a point, by the measured law 18.0 t^2 - 38 t^3 with t = beam
    /// radius / cell (within 3 % for t <= 0.15). Beyond, linear through the measured 0.428 at t = 0.20 and up
    /// to 1: a guide.
    double expected_volume_fraction(dvec3 p) const;

  private:
    struct BrickSize {
        int level;    ///< halvings of the largest cell
        double side;  ///< mm
    };
    VoronoiFoam(const FoamSettings& settings, FoamGround ground);
    BrickSize brick_size(dvec3 p) const;

    FoamSettings settings_;
    FoamGround ground_;
    std::shared_ptr<const CellUnits<BeamMaker>> units_;
    mutable CellCache<DistanceBrick> bricks_;
};

/// Throws InputError for settings out of range.
std::shared_ptr<const VoronoiFoam> make_voronoi_foam(const FoamSettings& settings);

}  // namespace lamella
