// Formats lengths, volumes and weights of filament, and times.
#include "printers/gcode/gcode_totals.h"

#include <fmt/format.h>

#include "engine/base/number_format.h"
#include "printers/gcode/gcode_text.h"

namespace lamella {

namespace {

/// Returns three lines: length, volume and weight of filament by tool (mm).
std::string used_text(const char* what, const std::vector<double>& filament, const PrinterProfile& profile) {
    const double diameter = profile.filament.filament;
    const double section = pi / 4 * diameter * diameter / 1000;  // cm3 per mm
    std::string lengths, volumes, weights;
    for (std::size_t tool = 0; tool < filament.size(); ++tool) {
        const double own = tool < profile.tools.size() ? profile.tools[tool].density : 0;
        const double density = own > 0 ? own : profile.support.density;
        const char* comma = tool > 0 ? ", " : "";
        lengths += comma + format_number(filament[tool], 2);
        volumes += comma + format_number(filament[tool] * section, 3);
        weights += comma + format_number(filament[tool] * section * density, 2);
    }
    return fmt::format("; {0} used [mm] = {1}\n; {0} used [cm3] = {2}\n; {0} used [g] = {3}\n", what, lengths,
                       volumes, weights);
}

}  // namespace

std::string facts_text(const GcodeTotals& totals, const PrinterProfile& profile, const RateMeter& rate,
                       bool has_supports, LayerRange range, double layer_height) {
    std::string text = used_text("filament", totals.filament, profile);
    if (has_supports && totals.filament.size() == 1)
        text += used_text("support material", {totals.support_filament}, profile);
    text += fmt::format("; filament density [g/cm3] = {}\n", format_number(profile.support.density, 3));
    text += fmt::format("; estimated printing time (normal mode) = {}\n", duration_text(totals.seconds));
    text += fmt::format("; worst segment rate [lines/s] = {} over {} lines\n", format_number(rate.worst(), 1),
                        profile.gcode.planner_blocks);
    if (profile.gcode.lines_per_second > 0)
        text += fmt::format("; slowed for the segment rate [mm] = {}\n", format_number(totals.slowed, 1));
    text += fmt::format("; total layers count = {}\n", range.count());
    text += fmt::format("; layer_height = {}\n", format_number(layer_height, 4));
    text += fmt::format("; islands too small for a bead = {}\n", totals.islands_left_out);
    return text;
}

}  // namespace lamella
