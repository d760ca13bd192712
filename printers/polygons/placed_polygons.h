// PlacedPolygons: polygons with bounding boxes, to select those near a region.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Returns the bounding box of the polygons, mm; empty for none.
Rect box_of(const Polygons& polygons);

/// The polygons of a whole layer. A boolean with a small region needs only those near it. Immutable.
class PlacedPolygons {
  public:
    PlacedPolygons() = default;
    explicit PlacedPolygons(Polygons polygons);

    const Polygons& all() const { return rings_; }
    /// Returns the rings that may affect a boolean within `where`: those whose boxes meet it, which includes
    /// all rings that enclose it.
    Polygons near(const Rect& where) const;

  private:
    Polygons rings_;
    std::vector<Rect> boxes_;
};

}  // namespace lamella
