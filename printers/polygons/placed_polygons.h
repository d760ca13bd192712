// Polygons whose rings are found by where they lie.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Smallest rectangle round the polygons, mm; empty for none.
Rect box_of(const Polygons& polygons);

/// The polygons of a whole layer, of which booleans with a small region need only those near it. Immutable.
class PlacedPolygons {
  public:
    PlacedPolygons() = default;
    explicit PlacedPolygons(Polygons polygons);

    const Polygons& all() const { return rings_; }
    /// The rings that may have to do with what lies in `where`: those whose boxes meet it, so also all that
    /// enclose it.
    Polygons near(const Rect& where) const;

  private:
    Polygons rings_;
    std::vector<Rect> boxes_;
};

}  // namespace lamella
