// BeamFoam: a foam whose pieces are beams.
#pragma once

#include "procedural/foam/piece_foam.h"

namespace lamella {

/// An infinite union of beams.
class BeamFoam : public PieceFoam<Beam> {
  public:
    /// Returns every beam that touches the box, once, in canonical order.
    std::vector<Beam> beams_touching(const Box& box) const { return pieces_touching(box); }
    /// Returns the beams that meet the region's rectangle at height z, in canonical order.
    std::vector<Beam> beams_at(double z) const {
        const Box region = bounds();
        return pieces_touching({{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z}});
    }

  protected:
    using PieceFoam::PieceFoam;
};

}  // namespace lamella
