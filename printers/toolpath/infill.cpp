// Lines and loops of infill, clipped to their region.
#include "printers/toolpath/infill.h"

#include <cmath>

#include "printers/toolpath/center_lines.h"
#include "printers/toolpath/thin_beads.h"

namespace lamella {
namespace {

/// Returns the region for the centre lines. The round end of a line reaches beyond its last point; an overlap
/// of a quarter width bonds it.
Polygons room_for_lines(const Polygons& region, const LineSettings& line) {
    return offset_polygons(region, line.width / 4 - line.spacing() / 2);
}

std::vector<Segment> lines_in(const Polygons& region, dvec2 direction, double first, double pitch, int count,
                              const LineSettings& line) {
    std::vector<Segment> lines = cut_lines(region, direction, first, pitch, count);
    std::erase_if(lines, [&](const Segment& s) { return s.length() < line.spacing() / 4; });
    return lines;
}

std::vector<Bead> beads_along(const std::vector<Segment>& lines, double width, Role role) {
    std::vector<Bead> beads;
    beads.reserve(lines.size());
    for (const Segment& s : lines) beads.push_back({{s.a, s.b}, width, role, false, 0});
    return beads;
}

}  // namespace

std::vector<Bead> sparse_lines(const Polygons& region, double density, dvec2 direction,
                               const LineSettings& line) {
    const Interval across = extent(region, left_of(direction));
    const double pitch = line.spacing() / density;
    const double first = std::floor(across.lo / pitch) * pitch;
    const int count = static_cast<int>(across.width() / pitch) + 2;
    return beads_along(lines_in(room_for_lines(region, line), direction, first, pitch, count, line),
                       line.width, Role::internal_infill);
}

std::vector<Bead> solid_lines(const Polygons& region, dvec2 direction, const LineSettings& line) {
    const double area = area_of(region), spacing = line.spacing();
    std::vector<Bead> single =
        center_line_beads(region, wall_thickness(region), area, line, Role::solid_infill);
    if (!single.empty()) return single;
    const Interval across = extent(region, left_of(direction));
    const int count = std::max(1, static_cast<int>(std::lround(across.width() / spacing)));
    const double pitch = across.width() / count;
    const Polygons room = room_for_lines(region, line);
    // In a narrow region the ends of the lines matter, so they extend to its border.
    for (const Polygons* within : {&room, &region}) {
        const std::vector<Segment> lines =
            lines_in(*within, direction, across.lo + pitch / 2, pitch, count, line);
        double length = 0;
        for (const Segment& s : lines) length += s.length();
        const bool enough = area <= length * spacing * LineSettings::max_extra_flow;
        if (!enough && (within != &region || length < spacing)) continue;
        return beads_along(lines, line.width_for(area, length), Role::solid_infill);
    }
    if (area > spacing * spacing / 8) return chord_bead(region, area, line);
    return {};
}

std::vector<Bead> concentric_loops(const Polygons& region, double density, const LineSettings& line) {
    const double pitch = line.spacing() / density;
    const Role role = density < 1 ? Role::internal_infill : Role::solid_infill;
    std::vector<Bead> beads;
    // Each loop is offset from the one before, not from the border: the inner loops are soon small.
    Polygons loops = offset_polygons(region, -pitch / 2);
    while (!loops.empty()) {
        for (const ClipperLib::Path& loop : loops)
            beads.push_back({to_points(loop), line.width, role, true, 0});
        loops = offset_polygons(loops, -pitch);
    }
    return beads;
}

}  // namespace lamella
