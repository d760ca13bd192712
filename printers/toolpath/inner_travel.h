// InnerTravel: travel paths inside one island of a layer that cross no outline.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "printers/polygons/polygon_sight.h"

namespace lamella {

/// Finds travel paths for any number of travels in an island. They keep about half a line width from the
/// outline, so that they cross no outer wall; a tenth where the island is too thin for that, such as in the
/// struts of foams.
class InnerTravel {
  public:
    /// `outline` is one of Toolpaths::outlines; `line_width` in mm.
    InnerTravel(Polygons outline, double line_width);

    /// Returns the inner corners of the shortest path. Returns nothing if there is no path, if the search
    /// takes too long (see shortest_way), or if the path is more than three times as long as the straight
    /// line.
    std::optional<std::vector<dvec2>> way(dvec2 from, dvec2 to);

  private:
    struct Region {
        double inset = 0;                        ///< mm
        std::optional<PolygonSight> sight = {};  ///< built on first use
    };
    std::optional<std::vector<dvec2>> way_within(Region& region, dvec2 from, dvec2 to) const;

    Polygons outline_;
    std::array<Region, 2> regions_;
};

}  // namespace lamella
