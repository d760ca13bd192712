// LayerBelow: the section that a layer rests on.
#pragma once

#include <vector>

#include "printers/polygons/placed_polygons.h"

namespace lamella {

/// The section of the layer below, part and supports. Immutable; thread-safe.
class LayerBelow {
  public:
    /// `pitch` is the row spacing of `holds`, mm.
    LayerBelow(Polygons below, double pitch);

    /// Returns true if p is supported from below. Exact along x; along y the nearest row decides.
    bool holds(dvec2 p) const;
    const PlacedPolygons& section() const { return section_; }

  private:
    PlacedPolygons section_;
    double pitch_;
    double first_ = 0;                 // y of the first row, mm
    std::vector<Interval> solid_;      // intervals along x, row by row, ascending
    std::vector<std::size_t> starts_;  // first interval of each row in solid_; one more entry than rows
};

}  // namespace lamella
