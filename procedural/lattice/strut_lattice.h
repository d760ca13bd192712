// StrutLattice: a unit cell of struts repeated over space; cells are halved where smaller ones are wanted.
#pragma once

#include <memory>
#include <vector>

#include "procedural/foam/beam_foam.h"
#include "procedural/foam/tapered_beams.h"
#include "procedural/lattice/lattice_struts.h"
#include "procedural/lattice/unit_cells.h"

namespace lamella {

/// Parameters of a strut lattice.
struct LatticeSettings {
    std::vector<Strut> struts;  ///< of the unit cell; ends are rounded to 2^-20 of a cell
    GradingPtr cell;            ///< side of a cell, mm
    GradingPtr beam;            ///< radius of the beams, mm; less than half a cell
    Box region;                 ///< where the lattice is wanted, mm; must be finite
    /// memory bound for cached cells, and as much again for distances
    std::size_t cache_bytes = std::size_t{64} << 20;
};

/// A lattice of round beams. Cells are the cubes of CellOctree: one size throughout if `cell` is constant,
/// otherwise the largest size, halved as often as needed; adjacent cells differ by at most one halving.
/// Corners of a large cell are corners of the small cells next to it, so lattices whose struts meet the
/// corners are connected across sizes. The region's lower corner is a corner of a cell. The lattice fills
/// space (outside the region the gradings are evaluated at its nearest point); `region` only bounds slices.
class StrutLattice : public BeamFoam {
  public:
    /// Throws InputError for settings out of range.
    explicit StrutLattice(const LatticeSettings& settings);

    /// Returns the beams that touch the box. A strut whose radius deviates from linear by more than 2 % is
    /// split into several beams. The order does not depend on the box.
    std::vector<Beam> pieces_touching(const Box& box) const override;
    /// NaN also at points 1e9 or more cells away from the region.
    double value(dvec3 p) const override;
    /// Returns the lattice with beams of radius + d, d >= 0; null for d < 0, where the joints have no closed
    /// form.
    FieldPtr offset(double d) const override;
    const LatticeSettings& settings() const { return settings_; }
    const CellOctree& cells() const { return struts_->cells(); }

  private:
    struct Checked {
        LatticeSettings settings;
    };
    explicit StrutLattice(const Checked& checked);
    StrutLattice(const LatticeSettings& settings, std::shared_ptr<const LatticeStruts> struts,
                 NodeRadius radius);

    LatticeSettings settings_;
    std::shared_ptr<const LatticeStruts> struts_;
    NodeRadius radius_;
};

/// Throws InputError for settings out of range.
std::shared_ptr<const StrutLattice> make_strut_lattice(const LatticeSettings& settings);

}  // namespace lamella
