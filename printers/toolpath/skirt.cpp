// Brim and skirt as offsets of the first layer's outer borders.
#include "printers/toolpath/skirt.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

int brim_loops(const ToolpathProfile& profile, const LineSettings& line) {
    return static_cast<int>(std::ceil(profile.brim / line.spacing() - 1e-9));
}

/// Returns the distance from the border to the centre line of a brim loop.
double brim_place(int loop, const LineSettings& line) { return line.width / 2 + loop * line.spacing(); }

double skirt_place(int loop, const ToolpathProfile& profile, const LineSettings& line) {
    const int brim = brim_loops(profile, line);
    const double edge = brim > 0 ? brim_place(brim - 1, line) + line.width / 2 : 0;
    return edge + profile.skirt_distance + brim_place(loop, line);
}

Polygons without_holes(Polygons polygons) {
    std::erase_if(polygons, [](const ClipperLib::Path& ring) { return !ClipperLib::Orientation(ring); });
    return polygons;
}

}  // namespace

std::vector<Bead> skirt_beads(const Polygons& standing, const ToolpathProfile& profile,
                              const LineSettings& line) {
    std::vector<Bead> beads;
    if (standing.empty()) return beads;
    const Polygons outlines = without_holes(standing);
    const auto add = [&](double place) {
        for (const ClipperLib::Path& ring : without_holes(offset_polygons(outlines, place)))
            beads.push_back({to_points(ring), line.width, Role::skirt, true, 0});
    };
    for (int loop = profile.skirt - 1; loop >= 0; --loop) add(skirt_place(loop, profile, line));
    for (int loop = brim_loops(profile, line) - 1; loop >= 0; --loop) add(brim_place(loop, line));
    return beads;
}

double skirt_reach(const ToolpathProfile& profile, const LineSettings& line) {
    if (profile.skirt > 0) return skirt_place(profile.skirt - 1, profile, line) + line.width / 2;
    const int brim = brim_loops(profile, line);
    return brim > 0 ? brim_place(brim - 1, line) + line.width / 2 : 0;
}

}  // namespace lamella
