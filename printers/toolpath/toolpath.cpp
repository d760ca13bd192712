// Splits contours into islands, plans the beads of each, and orders them.
#include "printers/toolpath/toolpath.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "printers/polygons/polygons.h"
#include "printers/toolpath/hanging_beads.h"
#include "printers/toolpath/island_planner.h"
#include "printers/toolpath/island_tour.h"

namespace lamella {
namespace {

/// Groups the contours into islands: an outer contour with the holes directly in it.
std::vector<Polygons> find_islands(const std::vector<Contour>& contours) {
    std::vector<std::size_t> island_of(contours.size());
    std::vector<Polygons> islands;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (contours[i].hole) continue;
        island_of[i] = islands.size();
        islands.push_back({to_polygon(contours[i].points)});
    }
    for (const Contour& contour : contours) {
        if (!contour.hole || contour.parent < 0) continue;
        islands[island_of[static_cast<std::size_t>(contour.parent)]].push_back(to_polygon(contour.points));
    }
    return islands;
}

/// Plans the beads of the islands that are large enough for one. A layer that is waited for alone has all
/// threads.
std::vector<std::vector<Bead>> plan_islands(const std::vector<Polygons>& islands,
                                            const ToolpathSettings& settings, int layer_index,
                                            const LayerNeighborhood& around, const CancelToken* cancel) {
    constexpr std::size_t together = 8;  // small islands cost less than the threads' agreement on them
    std::vector<std::vector<Bead>> planned(islands.size());
    isolated_parallel_for((islands.size() + together - 1) / together, [&](std::size_t group) {
        IslandPlanner planner(settings, layer_index, around, cancel);
        for (std::size_t i = group * together; i < std::min((group + 1) * together, islands.size()); ++i) {
            if (area_of(islands[i]) >= settings.line.min_area()) planned[i] = planner.plan(islands[i]);
        }
    });
    return planned;
}

}  // namespace

Toolpaths plan_toolpaths(const std::vector<Contour>& contours, const ToolpathSettings& settings,
                         int layer_index, const LayerNeighborhood& around, const CancelToken* cancel) {
    Toolpaths result;
    const std::vector<Polygons> islands = find_islands(contours);
    result.islands = static_cast<int>(islands.size());
    std::vector<std::vector<Bead>> planned = plan_islands(islands, settings, layer_index, around, cancel);
    std::vector<std::size_t> kept;  // of the islands
    std::vector<IslandStop> stops;
    Rect all;
    for (std::size_t i = 0; i < islands.size(); ++i) {
        for (const dvec2& p : to_points(islands[i].front())) all = unite(all, Rect{p, p});
        if (planned[i].empty()) {
            ++result.islands_left_out;
            continue;
        }
        stops.emplace_back(planned[i]);
        kept.push_back(i);
    }
    dvec2 at = all.lo;
    int number = 0;
    const TravelCost cost{settings.retract_from};
    const std::vector<std::size_t> tour = island_tour(stops, at, cost);
    for (std::size_t place = 0; place < tour.size(); ++place) {
        stop_if_cancelled(cancel);
        const std::size_t here = kept[tour[place]];
        std::vector<Bead>& beads = planned[here];
        for (Bead& bead : beads) bead.island = number;
        ++number;
        result.outlines.push_back(beads.size() > 1 ? simplified(islands[here], settings.line.tolerance / 2)
                                                   : Polygons());
        const IslandStop* const next = place + 1 < tour.size() ? &stops[tour[place + 1]] : nullptr;
        append_island(beads, settings.seam, next, cost, at, result.beads);
    }
    stop_if_cancelled(cancel);
    if (around.footing) result.beads = cut_hanging(result.beads, *around.footing);
    return result;
}

}  // namespace lamella
