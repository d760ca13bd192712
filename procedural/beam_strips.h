// The slice of a foam of beams, in strips.
#pragma once

#include "procedural/plane_strips.h"

namespace lamella {

/// Runs of infinitely many beams in one plane.
class BeamStrips : public PlaneStrips {
  public:
    /// All beams that touch a box.
    using Query = std::function<std::vector<Beam>(const Box&)>;
    BeamStrips(const Field& field, Query beams_touching, const Rect& region, int strips, double z)
        : PlaneStrips(
              field,
              [query = std::move(beams_touching)](const Box& box) {
                  return PlanePieces{query(box), {}};
              },
              region, strips, z) {}
};

}  // namespace lamella
