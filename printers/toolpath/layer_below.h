// LayerBelow: what a layer rests on.
#pragma once

#include <vector>

#include "printers/polygons/placed_polygons.h"

namespace lamella {

/// The section of the layer below, of the part and of its supports. Immutable; any thread may ask it.
class LayerBelow {
  public:
    /// `pitch` mm is how finely `holds` looks.
    LayerBelow(Polygons below, double pitch);

    /// Whether there is something under p: exact along x, by the nearest of the rows along y.
    bool holds(dvec2 p) const;
    const PlacedPolygons& section() const { return section_; }

  private:
    PlacedPolygons section_;
    double pitch_;
    double first_ = 0;                 // y of the first row, mm
    std::vector<Interval> solid_;      // along x, row by row, ascending
    std::vector<std::size_t> starts_;  // of each row in solid_, one more than there are rows
};

}  // namespace lamella
