// Ways over one island of a layer, on which the nozzle crosses no outline.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "printers/polygons/polygon_sight.h"

namespace lamella {

/// Finds them for as many travels as an island has. They keep half a line's width from the outline, so that
/// they cross no outer wall; a tenth where the island is too thin for that, as struts of foams are.
class InnerTravel {
  public:
    /// The outline as of Toolpaths::outlines; width of a line in mm.
    InnerTravel(Polygons outline, double line_width);

    /// The corners of the shortest way, ends left out; nothing where there is none or it would take too long
    /// to find (see shortest_way), or where it is more than three times as long as the straight one.
    std::optional<std::vector<dvec2>> way(dvec2 from, dvec2 to);

  private:
    struct Region {
        double inset = 0;                        ///< mm
        std::optional<PolygonSight> sight = {};  ///< once it has been needed
    };
    std::optional<std::vector<dvec2>> way_within(Region& region, dvec2 from, dvec2 to) const;

    Polygons outline_;
    std::array<Region, 2> regions_;
};

}  // namespace lamella
