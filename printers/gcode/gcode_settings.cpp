// Limits of settings, and their description in one line.
#include "printers/gcode/gcode_settings.h"

#include <fmt/format.h>

#include <utility>

#include "engine/base/error.h"
#include "printers/gcode/gcode_flavour.h"
#include "printers/gcode/gcode_script.h"

namespace lamella {
namespace {

constexpr double slowest = 0.1;  // mm/s
constexpr double fastest = 2000;

void check(const char* key, double value, double lo, double hi) {
    if (!(value >= lo && value <= hi)) {
        throw InputError(fmt::format("{} = {}: must be {} to {}", key, value, lo, hi));
    }
}

void check_gcode_profile(const GcodeProfile& profile) {
    check("first_layer_nozzle_temperature", profile.first_layer_nozzle_temperature, 0, 500);
    check("first_layer_bed_temperature", profile.first_layer_bed_temperature, 0, 250);
    check("fan", profile.fan, 0, 1);
    check("least_layer_time", profile.min_layer_time, 0, 3600);
    check("least_speed", profile.min_speed, slowest, fastest);
    for (const auto& [key, speed] :
         {std::pair("wall_speed", profile.wall_speed),
          std::pair("inner_wall_speed", profile.inner_wall_speed),
          std::pair("infill_speed", profile.infill_speed), std::pair("solid_speed", profile.solid_speed),
          std::pair("thin_speed", profile.thin_speed), std::pair("bridge_speed", profile.bridge_speed)}) {
        if (speed != 0) check(key, speed, slowest, fastest);
    }
    check("bridge_flow", profile.bridge_flow, 0.1, 5);
    check("bridge_fan", profile.bridge_fan, 0, 1);
    check("retract_from", profile.retract_from, 0, 1e5);
    check("retract_inside_from", profile.retract_inside_from, 0, 1e5);
    check("wipe", profile.wipe, 0, 100);
    check("z_hop", profile.z_hop, 0, 20);
    check("z_hop_from", profile.z_hop_from, 0, 1e5);
    check("acceleration", profile.acceleration, 1, 1e6);
    for (const auto& [key, acceleration] :
         {std::pair("wall_acceleration", profile.wall_acceleration),
          std::pair("travel_acceleration", profile.travel_acceleration),
          std::pair("first_layer_acceleration", profile.first_layer_acceleration)}) {
        if (acceleration != 0) check(key, acceleration, 1, 1e6);
    }
    check("junction_deviation", profile.junction_deviation, 0.001, 1);
    check("planner_blocks", profile.planner_blocks, 2, 1000);
    check("lines_per_second", profile.lines_per_second, 0, 1e6);
    check_scripts(profile);
}

}  // namespace

void check_filament_profile(const PrinterProfile& printer, double height) {
    const FilamentProfile& profile = printer.filament;
    check("bed_x", profile.bed_x, 30, 10000);
    check("bed_y", profile.bed_y, 30, 10000);
    check("bed_z", profile.bed_z, 1, 10000);
    check("nozzle", profile.nozzle, 0.05, 5);
    check("filament", profile.filament, 0.5, 5);
    check("line_width", profile.line_width, 0.05, 10);
    check("infill_density", profile.infill_density, 0, 1);
    check("nozzle_temperature", profile.nozzle_temperature, 0, 500);
    check("bed_temperature", profile.bed_temperature, 0, 250);
    check("print_speed", profile.print_speed, slowest, fastest);
    check("first_layer_speed", profile.first_layer_speed, slowest, fastest);
    check("travel_speed", profile.travel_speed, slowest, fastest);
    check("retraction", profile.retraction, 0, 20);
    check("retraction_speed", profile.retraction_speed, 0.1, 500);
    check("tolerance", profile.tolerance, 0.0001, 1);
    check("walls", printer.toolpath.walls, 1, 1000);
    check("top_layers", printer.toolpath.top_layers, 0, 1000);
    check("bottom_layers", printer.toolpath.bottom_layers, 0, 1000);
    check("brim", printer.toolpath.brim, 0, 1000);
    check("skirt", printer.toolpath.skirt, 0, 1000);
    check("skirt_distance", printer.toolpath.skirt_distance, 0, 1000);
    check_gcode_profile(printer.gcode);
    if (profile.infill_density > 0 && profile.infill_density < 0.01) {
        throw InputError(fmt::format("infill_density = {}: must be 0, or 0.01 to 1", profile.infill_density));
    }
    if (!(height > 0 && height <= profile.line_width)) {
        throw InputError(
            fmt::format("layers of {} mm cannot be made with lines {} mm wide: a line is at least as "
                        "wide as high; choose thinner layers or a larger line_width",
                        height, profile.line_width));
    }
}

void check_support_speed(const SupportProfile& profile) {
    check("speed of supports", profile.speed, slowest, fastest);
}

void check_laser_profile(const PrinterProfile& printer) {
    const LaserProfile& profile = printer.laser;
    check("bed_x", printer.filament.bed_x, 1, 1e5);
    check("bed_y", printer.filament.bed_y, 1, 1e5);
    check("tolerance", printer.vector.tolerance, 0.0001, 10);
    check("kerf", printer.cutting.kerf, 0, 10);
    check("cut_power", profile.cut_power, 0, 1);
    check("engrave_power", profile.engrave_power, 0, 1);
    check("cut_speed", profile.cut_speed, slowest, fastest);
    check("engrave_speed", profile.engrave_speed, slowest, fastest);
    check("power_steps", profile.power_steps, 1, 1e6);
    check("cut_passes", profile.cut_passes, 1, 1000);
    check_gcode_profile(printer.gcode);
}

namespace {

/// Returns the settings of several tools; nothing where there is one.
std::string tool_settings(const PrinterProfile& profile) {
    if (profile.tools.empty()) return "";
    const PurgeProfile& purge = profile.purge;
    std::string text = fmt::format(" purge {} {} {} {}", purge.volume, purge.width, purge.gap, purge.density);
    for (const ToolProfile& tool : profile.tools)
        text += fmt::format(" tool {} {} {} {}", tool.nozzle_temperature, tool.first_layer_nozzle_temperature,
                            tool.standby_temperature, tool.density);
    return text + "\ntools\n" + tool_script(profile.gcode);
}

}  // namespace

std::string gcode_settings(const PrinterProfile& profile) {
    const FilamentProfile& f = profile.filament;
    const GcodeProfile& g = profile.gcode;
    const ToolpathProfile& t = profile.toolpath;
    return fmt::format("gcode {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(g.flavour),
                       f.bed_x, f.bed_y, f.bed_z, f.nozzle, f.filament, f.line_width, f.infill_density,
                       f.nozzle_temperature, f.bed_temperature, f.print_speed, f.first_layer_speed,
                       f.travel_speed, f.retraction, f.retraction_speed, f.tolerance) +
           fmt::format(" heat {} {} fan {} {} {} time {} {} speeds {} {} {} {} {}",
                       g.first_layer_nozzle_temperature, g.first_layer_bed_temperature, g.fan,
                       g.fan_off_layers, g.fan_ramp_layers, g.min_layer_time, g.min_speed, g.wall_speed,
                       g.inner_wall_speed, g.infill_speed, g.solid_speed, g.thin_speed) +
           fmt::format(" bridges {} {} {}", g.bridge_speed, g.bridge_flow, g.bridge_fan) +
           fmt::format(" motion {} {} {} {} {} {} {} {} prime {}", g.acceleration, g.wall_acceleration,
                       g.travel_acceleration, g.first_layer_acceleration, g.junction_deviation,
                       g.planner_blocks, g.lines_per_second, g.arcs, g.prime_line) +
           (g.label_objects ? "" : " no labels") +
           fmt::format(" travel {} {} {} wipe {} hop {} {}", g.travel_inside, g.retract_from,
                       g.retract_inside_from, g.wipe, g.z_hop, g.z_hop_from) +
           fmt::format(" paths {} {} {} {} {} {} {} {}", t.walls, t.top_layers, t.bottom_layers,
                       static_cast<int>(t.infill), static_cast<int>(t.seam), t.brim, t.skirt,
                       t.skirt_distance) +
           tool_settings(profile) + "\nstart\n" + start_script(g) + "\nlayer\n" + layer_script(g) +
           "\nend\n" + end_script(g);
}

}  // namespace lamella
