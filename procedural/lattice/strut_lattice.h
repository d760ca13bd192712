// StrutLattice: a unit cell of struts repeated over space, in cells that are halved where finer ones are
// asked.
#pragma once

#include <memory>
#include <vector>

#include "procedural/foam/beam_foam.h"
#include "procedural/foam/tapered_beams.h"
#include "procedural/lattice/lattice_struts.h"
#include "procedural/lattice/unit_cells.h"

namespace lamella {

/// What a lattice of struts is made of.
struct LatticeSettings {
    std::vector<Strut> struts;                        ///< of the unit cell; ends count to 2^-20 of a cell
    GradingPtr cell;                                  ///< side of a cell, mm
    GradingPtr beam;                                  ///< radius of the beams, mm; less than half a cell
    Box region;                                       ///< where the lattice is wanted, mm; finite
    std::size_t cache_bytes = std::size_t{64} << 20;  ///< bound of the memory for cells, and for distances
};

/// A lattice of round beams. Cells are the cubes of CellOctree: one size throughout when one is asked for,
/// otherwise the largest size asked for, halved as often as needed, neighbours differing by one halving at
/// most. The corners of a large cell are corners of the small ones beside it, so lattices whose struts meet
/// the corners hang together across sizes. A cell's corner lies at the region's lower corner. The lattice
/// fills space (beyond the region the gradings count at the nearest point of it); the region says where
/// slices and bounds are wanted.
class StrutLattice : public BeamFoam {
  public:
    /// Throws InputError for settings out of range.
    explicit StrutLattice(const LatticeSettings& settings);

    /// A strut along which the radius bends by more than 2 % is several beams end to end. The order does not
    /// depend on the box.
    std::vector<Beam> pieces_touching(const Box& box) const override;
    /// NaN also where it lies 1e9 cells away.
    double value(dvec3 p) const override;
    /// The lattice with beams of radius + d, d >= 0; null for d < 0, where the joints have no closed form.
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
