// BeamFoam: a foam of beams alone.
#pragma once

#include <vector>

#include "procedural/piece_foam.h"

namespace lamella {

/// The union of infinitely many beams, known by what touches a box.
class BeamFoam : public PieceFoam<Beam> {
  public:
    /// Every beam whose solid touches the box, once, in canonical order.
    virtual std::vector<Beam> beams_touching(const Box& box) const = 0;
    std::vector<Beam> pieces_touching(const Box& box) const final { return beams_touching(box); }
    /// The beams that meet the region's rectangle at height z, in canonical order.
    std::vector<Beam> beams_at(double z) const {
        const Box region = bounds();
        return beams_touching({{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z}});
    }

  protected:
    using PieceFoam::PieceFoam;
};

}  // namespace lamella
