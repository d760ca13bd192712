// VoronoiFoam: the open-cell foam whose beams run along the edges of a Voronoi diagram.
#pragma once

#include <memory>
#include <vector>

#include "procedural/foam/beam_foam.h"
#include "procedural/foam/cell_units.h"
#include "procedural/foam/foam_settings.h"

namespace lamella {

/// The Voronoi foam of Martinez, Dumas and Lefebvre (SIGGRAPH 2016), made exact: the union of round beams
/// along all edges of the Voronoi diagram of jittered seeds, its cell size and beam radius graded. It fills
/// space; the region only says where slices and bounds are wanted.
class VoronoiFoam : public BeamFoam {
  public:
    /// Throws InputError for settings out of range.
    explicit VoronoiFoam(const FoamSettings& settings);

    std::vector<Beam> pieces_touching(const Box& box) const override { return units_->touching(box); }
    /// The foam with beams of radius + d, d >= 0; null for d < 0, where the joints have no closed form.
    FieldPtr offset(double d) const override;

    const FoamSettings& settings() const { return settings_; }
    /// The cell sizes of the region, mm.
    Interval cells() const { return ground_.cells; }
    /// All seeds in the closed box, by key.
    std::vector<Seed> seeds_in(const Box& box) const { return ground_.seeds_in(box); }
    /// The share of space that is solid about a point, by the measured law 18.0 t^2 - 38 t^3 with t = beam
    /// radius / cell (within 3 % for t <= 0.15). Beyond, linear through the measured 0.428 at t = 0.20 and up
    /// to 1: a guide.
    double expected_volume_fraction(dvec3 p) const;

  private:
    VoronoiFoam(const FoamSettings& settings, FoamSeeding ground);

    FoamSettings settings_;
    FoamSeeding ground_;
    std::shared_ptr<const CellUnits<FramedMaker<BeamMaker>>> units_;
};

/// Throws InputError for settings out of range.
std::shared_ptr<const VoronoiFoam> make_voronoi_foam(const FoamSettings& settings);

}  // namespace lamella
