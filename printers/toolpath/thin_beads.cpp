// Widths and flows of beads, computed from the volume to be laid.
#include "printers/toolpath/thin_beads.h"

#include <algorithm>

#include "printers/toolpath/center_lines.h"

namespace lamella {
namespace {}  // namespace

std::vector<Bead> tapered_beads(const ThinParts& parts, double area, const LineSettings& line, Role role) {
    double laid = 0, ends = 0;
    for (const TaperedLine& path : parts.lines) {
        laid += area_of(path);
        const double a = path.thickness.front(), b = path.thickness.back();
        if (!path.closed) ends += pi / 8 * (a * a + b * b);
    }
    if (!(laid > 0)) return {};
    const double wanted = area / laid;
    const double flow = std::clamp(wanted, 1.0, 1 + ends / laid);
    const double wider = std::clamp(wanted / flow, LineSettings::min_flow, LineSettings::max_extra_flow);
    std::vector<Bead> beads;
    for (const TaperedLine& path : parts.lines) {
        Bead bead;
        bead.points = path.points;
        bead.closed = path.closed;
        bead.role = role;
        bead.flow = flow;
        for (const double thickness : path.thickness) {
            const double width = bead_width(wider * thickness * line.height, line.height);
            bead.widths.push_back(std::clamp(width, LineSettings::narrowest * line.width,
                                             LineSettings::widest_tapered * line.width));
        }
        bead.width = std::ranges::max(bead.widths);
        beads.push_back(std::move(bead));
    }
    return beads;
}

std::vector<Bead> center_line_beads(const Polygons& region, double thickness, double area,
                                    const LineSettings& line, Role role) {
    if (thickness > line.thickest()) return {};
    const std::vector<CenterLine> paths = center_lines(region, thickness, line.tolerance);
    double length = 0;
    for (const CenterLine& path : paths) length += length_of(path);
    if (!(length > 0)) return {};
    std::vector<Bead> beads;
    beads.reserve(paths.size());
    for (const CenterLine& path : paths)
        beads.push_back({path.points, line.width_for(area, length), role, path.closed, 0});
    return beads;
}

std::vector<Bead> loop_beads(const Polygons& piece, double inset, double area, const LineSettings& line,
                             Role role) {
    const Polygons loops = offset_polygons(piece, -inset);
    const double length = perimeter_of(loops);
    std::vector<Bead> beads;
    if (!(length > 0)) return beads;
    for (const ClipperLib::Path& loop : loops)
        beads.push_back({to_points(loop), line.width_for(area, length), role, true, 0});
    return beads;
}

std::vector<Bead> chord_bead(const Polygons& region, double area, const LineSettings& line) {
    const Segment chord = longest_chord(region);
    const double length = chord.length();
    if (!(length > 0)) return {};
    const double least = std::min(area / line.thickest(), length);
    const double shrink = std::min({line.width / 2, length / 4, (length - least) / 2}) / length;
    const dvec2 step = (chord.b - chord.a) * shrink;
    const Segment path{chord.a + step, chord.b - step};
    return {{{path.a, path.b}, line.width_for(area, path.length()), Role::gap_fill, false, 0}};
}

}  // namespace lamella
