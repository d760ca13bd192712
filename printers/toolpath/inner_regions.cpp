// Booleans of a region with the adjacent layers.
#include "printers/toolpath/inner_regions.h"

#include <algorithm>

#include "printers/toolpath/bridge_direction.h"

namespace lamella {
namespace {

constexpr double anchor = 3;       // overlap of bridges and solid parts with their surroundings, in widths
constexpr double min_bridge = 9;   // in widths squared; smaller unsupported regions are no bridges
constexpr double min_sparse = 64;  // in widths squared; smaller sparse regions become solid

/// Returns the opening: removes everything narrower than `width` mm.
Polygons opened(const Polygons& polygons, double width) {
    return intersect_polygons(offset_polygons(offset_polygons(polygons, -width / 2), width / 2 * 1.01),
                              polygons);
}

/// Returns true if the unsupported part of a region may be large enough for a bridge; sampled a width apart.
bool may_hang(const Polygons& region, const LayerBelow& footing, double width) {
    const Interval across = extent(region, {0, 1});
    const int rows = std::max(1, static_cast<int>(across.width() / width));
    const double pitch = across.width() / rows;
    double hanging = 0;
    for (const Segment& s : cut_lines(region, {1, 0}, across.lo + pitch / 2, pitch, rows)) {
        const int points = std::max(1, static_cast<int>(s.length() / width));
        for (int i = 0; i < points; ++i) {
            if (!footing.holds(s.a + (s.b - s.a) * ((i + 0.5) / points)))
                hanging += pitch * s.length() / points;
        }
    }
    return hanging > min_bridge * width * width / 2;  // half, because the sampling is coarse
}

/// Returns the part where infill must be solid, because a surface is near.
Polygons solid_part(const Polygons& region, const PlacedPolygons& core, double width) {
    Polygons bare = opened(subtract_polygons(region, core.near(box_of(region))), width / 2);
    if (bare.empty()) return bare;
    Polygons solid = intersect_polygons(offset_polygons(bare, anchor * width), region);
    // A region stays sparse only if it has room for more than its own border.
    for (const Polygons& rest : split_pieces(subtract_polygons(region, solid))) {
        if (area_of(rest) < min_sparse * width * width || opened(rest, 2 * width).empty())
            solid = unite_polygons(solid, rest);
    }
    return solid;
}

/// Returns the unsupported part of a region, where at least a whole bead's width hangs.
Polygons hanging_part(const Polygons& region, const LayerBelow& footing, double width) {
    if (!may_hang(region, footing, width)) return {};
    Polygons bridges;
    const Polygons bare = subtract_polygons(region, footing.section().near(box_of(region)));
    for (const Polygons& piece : split_pieces(opened(bare, width))) {
        if (area_of(piece) >= min_bridge * width * width)
            bridges.insert(bridges.end(), piece.begin(), piece.end());
    }
    return bridges;
}

/// Returns the bridges over the unsupported part of a solid region, with a strip of their surroundings that
/// anchors their lines.
std::vector<InnerRegion> bridges_over(const Polygons& hanging, const Polygons& solid,
                                      const LayerBelow& footing, double width) {
    std::vector<InnerRegion> bridges;
    for (Polygons& piece :
         split_pieces(intersect_polygons(offset_polygons(hanging, anchor * width), solid))) {
        const Polygons spanned = intersect_polygons(hanging, piece);
        if (spanned.empty()) continue;
        const dvec2 along = bridge_direction(spanned, footing, width);
        bridges.push_back({std::move(piece), InnerRegion::Fill::bridge, along});
    }
    return bridges;
}

void append_pieces(const Polygons& polygons, InnerRegion::Fill fill, double min_area,
                   std::vector<InnerRegion>& regions) {
    for (Polygons& piece : split_pieces(polygons)) {
        if (area_of(piece) >= min_area) regions.push_back({std::move(piece), fill});
    }
}

}  // namespace

std::vector<InnerRegion> divide_inside(const Polygons& region, const LayerNeighborhood& around,
                                       double density, const LineSettings& line) {
    const bool all_solid = density > densest_lattice;
    const Polygons solid = all_solid     ? region
                           : around.core ? solid_part(region, *around.core, line.width)
                                         : Polygons();
    const Polygons hanging =
        around.footing && !solid.empty() ? hanging_part(solid, *around.footing, line.width) : Polygons();
    if (all_solid && hanging.empty()) return {{region}};
    std::vector<InnerRegion> regions;
    if (!hanging.empty()) regions = bridges_over(hanging, solid, *around.footing, line.width);
    Polygons other = solid;
    for (const InnerRegion& bridge : regions) other = subtract_polygons(other, bridge.region);
    const double least = line.min_area();
    append_pieces(other, InnerRegion::Fill::solid, least, regions);
    if (!all_solid)
        append_pieces(subtract_polygons(region, solid), InnerRegion::Fill::sparse, least, regions);
    return regions;
}

}  // namespace lamella
