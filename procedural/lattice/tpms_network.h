// TpmsNetwork: the level below which g is solid, so that the struts of a network have a thickness.
#pragma once

#include <vector>

#include "procedural/lattice/tpms_surface.h"

namespace lamella {

/// The levels of one surface's network, tabulated. The struts' axes join the minima of g by straight lines,
/// over saddles of g; symmetry makes one half of an axis stand for all.
class TpmsNetwork {
  public:
    explicit TpmsNetwork(TpmsKind kind);

    /// Returns the lowest level at which all points within half a strut's thickness (radians of the angles)
    /// of the axes are solid. It rises with the thickness.
    double level(double half) const;
    /// Half the thickness at which the other side of the surface is no longer connected.
    double greatest_half() const { return greatest_half_; }
    /// Upper bound of the change of the level per radian.
    double steepest() const { return steepest_; }

  private:
    struct Entry {
        double level, slope;
    };
    Entry entry(double half) const;

    TpmsKind kind_;
    double step_, greatest_half_, steepest_;
    std::vector<Entry> entries_;  ///< at the multiples of step_
};

}  // namespace lamella
