// Splits contours into islands, plans the beads of each, and orders them.
#include "printers/toolpath/toolpath.h"

#include <algorithm>

#include "printers/polygons/polygons.h"
#include "printers/toolpath/bead_order.h"
#include "printers/toolpath/hanging_beads.h"
#include "printers/toolpath/island_planner.h"

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

}  // namespace

Toolpaths plan_toolpaths(const std::vector<Contour>& contours, const ToolpathSettings& settings,
                         int layer_index, const LayerNeighborhood& around, const CancelToken* cancel) {
    Toolpaths result;
    const std::vector<Polygons> islands = find_islands(contours);
    result.islands = static_cast<int>(islands.size());
    std::vector<std::vector<Bead>> planned;
    std::vector<const Polygons*> outlines;
    std::vector<dvec2> entries;
    Rect all;
    IslandPlanner planner(settings, layer_index, around, cancel);
    for (const Polygons& island : islands) {
        for (const dvec2& p : to_points(island.front())) all = unite(all, Rect{p, p});
        std::vector<Bead> beads;
        if (area_of(island) >= settings.line.min_area()) beads = planner.plan(island);
        if (beads.empty()) {
            ++result.islands_left_out;
            continue;
        }
        entries.push_back(beads.front().points.front());
        planned.push_back(std::move(beads));
        outlines.push_back(&island);
    }
    dvec2 at = all.lo;
    int number = 0;
    for (const std::size_t next : short_tour(entries, at)) {
        stop_if_cancelled(cancel);
        std::vector<Bead>& beads = planned[next];
        for (Bead& bead : beads) bead.island = number;
        ++number;
        result.outlines.push_back(beads.size() > 1 ? simplified(*outlines[next], settings.line.tolerance / 2)
                                                   : Polygons());
        // Walls are printed before infill, because they hold it.
        const auto infill =
            std::stable_partition(beads.begin(), beads.end(), [](const Bead& bead) { return bead.closed; });
        const auto walls = static_cast<std::size_t>(infill - beads.begin());
        append_nearest(std::span(beads).first(walls), settings.seam, at, result.beads);
        append_nearest(std::span(beads).subspan(walls), settings.seam, at, result.beads);
    }
    stop_if_cancelled(cancel);
    if (around.footing) result.beads = cut_hanging(result.beads, *around.footing);
    return result;
}

}  // namespace lamella
