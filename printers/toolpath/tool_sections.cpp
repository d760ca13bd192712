// Polygon booleans with the zones' sections, the last zone first.
#include "printers/toolpath/tool_sections.h"

#include <map>
#include <utility>

#include "printers/polygons/polygons.h"

namespace lamella {

namespace {

Polygons section_of(const Field& zone, double z, double tolerance) {
    if (const Box box = zone.bounds(); z < box.lo.z || z > box.hi.z) return {};
    SliceContext context;
    Scratch scratch;
    return to_polygons(trace_contours(context.slice(zone, z), tolerance, scratch));
}

Polygons without_slivers(const Polygons& polygons, double thinnest) {
    Polygons kept;
    for (Polygons& piece : split_pieces(polygons)) {
        if (2 * area_of(piece) < thinnest * perimeter_of(piece)) continue;
        kept.insert(kept.end(), piece.begin(), piece.end());
    }
    return kept;
}

}  // namespace

std::vector<ToolSection> divide_by_tool(const std::vector<Contour>& section, std::span<const ToolZone> zones,
                                        double z, double tolerance, double thinnest) {
    if (section.empty()) return {};
    if (zones.size() <= 1) return {{zones.empty() ? 0 : zones.front().tool, section}};
    std::map<int, Polygons> shares;
    Polygons left = to_polygons(section);
    for (std::size_t i = zones.size(); i-- > 0 && !left.empty();) {
        Polygons zone;
        if (zones[i].zone) zone = section_of(*zones[i].zone, z, tolerance);
        if (zones[i].zone && zone.empty()) continue;
        const Polygons taken = zones[i].zone ? intersect_polygons(left, zone) : left;
        left = zones[i].zone ? subtract_polygons(left, zone) : Polygons();
        Polygons& share = shares[zones[i].tool];
        share = share.empty() ? taken : unite_polygons(share, taken);
    }
    std::vector<ToolSection> sections;
    for (const auto& [tool, share] : shares) {
        std::vector<Contour> contours = to_contours(without_slivers(share, thinnest));
        if (!contours.empty()) sections.push_back({tool, std::move(contours)});
    }
    return sections;
}

}  // namespace lamella
