// Shortest paths within the inset outline.
#include "printers/toolpath/inner_travel.h"

#include <utility>

#include "printers/polygons/shortest_way.h"

namespace lamella {
namespace {

constexpr double max_detour = 3;  // longer detours are worse than a retraction

}  // namespace

InnerTravel::InnerTravel(Polygons outline, double line_width)
    : outline_(std::move(outline)), regions_{{{line_width / 2}, {line_width / 10}}} {}

std::optional<std::vector<dvec2>> InnerTravel::way(dvec2 from, dvec2 to) {
    for (Region& region : regions_) {
        if (auto found = way_within(region, from, to)) return found;
    }
    return std::nullopt;
}

std::optional<std::vector<dvec2>> InnerTravel::way_within(Region& region, dvec2 from, dvec2 to) const {
    // A coarser outline makes the offset faster.
    constexpr double coarse = 1.0 / 6;
    if (!region.sight)
        region.sight.emplace(offset_polygons(simplified(outline_, coarse * region.inset), -region.inset));
    // Beads begin and end on the region's border or, after rounding, beside it. Within the inset, the path to
    // such a point cannot leave the island.
    constexpr double share = 0.8;
    const double reach = share * region.inset * polygon_scale;
    const ClipperLib::Path ends = to_polygon({from, to});
    const auto begin = region.sight->enter(ends[0], reach), end = region.sight->enter(ends[1], reach);
    if (!begin || !end) return std::nullopt;
    auto corners =
        shortest_way(*region.sight, *begin, *end, max_detour * polygon_scale * glm::distance(from, to));
    if (!corners) return std::nullopt;
    if (*begin != ends[0]) corners->insert(corners->begin(), *begin);
    if (*end != ends[1]) corners->push_back(*end);
    return to_points(*corners);
}

}  // namespace lamella
