// The rows of the settings table about G-code: dialect, scripts, temperatures, fan, speeds, motion, laser.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(Flavour) {
    static const std::vector<std::string> list{"marlin", "klipper", "reprapfirmware", "grbl"};
    return list;
}

namespace {

constexpr Limits speeds{0.1, 2000};
constexpr Limits speeds_or_none{0, 2000};
constexpr Limits accelerations{1, 1e6};
constexpr Limits accelerations_or_none{0, 1e6};
constexpr Limits share{0, 1};

template <auto member>
void add_gcode_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    constexpr auto place = [](Recipe & r) -> auto& { return r.printer.gcode.*member; };
    t.push_back(row<place>("printer", key, flag, std::move(facts)));
}

template <auto member>
void add_laser_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    constexpr auto place = [](Recipe & r) -> auto& { return r.printer.laser.*member; };
    t.push_back(row<place>("printer", key, flag, std::move(facts)));
}

void add_scripts(std::vector<Setting>& t) {
    using G = GcodeProfile;
    add_gcode_row<&G::flavour>(
        t, "flavour", "--printer-flavour",
        {.help = "Firmware for which G-code is written; grbl cuts layers with a laser."});
    add_gcode_row<&G::start_script>(t, "start_script", "--printer-start-script",
                                    {.fallback = "heat, home, wait for the heat",
                                     .help = "Start lines that replace the default, with "
                                             "{nozzle_temperature}, {bed_temperature}, {layers} and so on.",
                                     .is_lines = true});
    add_gcode_row<&G::layer_script>(
        t, "layer_script", "--printer-layer-script",
        {.fallback = "none; under grbl a pause before the next sheet",
         .help = "Lines before each layer, with {layer}, {z}, {height} and so on.",
         .is_lines = true});
    add_gcode_row<&G::end_script>(
        t, "end_script", "--printer-end-script",
        {.fallback = "all off",
         .help = "End lines that replace the default, with {filament_used}, {z} and so on.",
         .is_lines = true});
    add_gcode_row<&G::tool_script>(
        t, "tool_script", "--printer-tool-script",
        {.fallback = "T{tool}, wait for the heat",
         .help = "Lines that change the tool and replace the default, with {tool}, {previous_tool}, "
                 "{nozzle_temperature} and so on.",
         .is_lines = true});
    add_gcode_row<&G::prime_line>(t, "prime_line", "--printer-prime-line",
                                  {.help = "Fill the nozzle with a line along the bed's front edge."});
}

void add_heat(std::vector<Setting>& t) {
    using G = GcodeProfile;
    add_gcode_row<&G::first_layer_nozzle_temperature>(
        t, "first_layer_nozzle_temperature", "--printer-first-layer-nozzle-temperature",
        {.unit = "degrees Celsius",
         .limits = {0, 500},
         .help = "Temperature of the nozzle for the first layer; 0: as for other layers."});
    add_gcode_row<&G::first_layer_bed_temperature>(
        t, "first_layer_bed_temperature", "--printer-first-layer-bed-temperature",
        {.unit = "degrees Celsius",
         .limits = {0, 250},
         .help = "Temperature of the bed for the first layer; 0: as for other layers."});
    add_gcode_row<&G::fan>(
        t, "fan", "--printer-fan",
        {.limits = share, .help = "Speed of the part cooling fan, as a share of full speed."});
    add_gcode_row<&G::fan_off_layers>(
        t, "fan_off_layers", "--printer-fan-off-layers",
        {.unit = "layers", .limits = {0, 1e6}, .help = "Number of first layers printed without fan."});
    add_gcode_row<&G::fan_ramp_layers>(
        t, "fan_ramp_layers", "--printer-fan-ramp-layers",
        {.unit = "layers",
         .limits = {0, 1e6},
         .help = "Number of layers over which the fan then rises to its speed."});
    add_gcode_row<&G::min_layer_time>(t, "least_layer_time", "--printer-least-layer-time",
                                      {.unit = "s",
                                       .limits = {0, 3600},
                                       .help = "Minimum time of a layer: faster layers are slowed down."});
    add_gcode_row<&G::min_speed>(
        t, "least_speed", "--printer-least-speed",
        {.unit = "mm/s",
         .limits = speeds,
         .help = "Minimum speed of layers that are slowed down for least_layer_time."});
}

void add_speeds(std::vector<Setting>& t) {
    using G = GcodeProfile;
    const auto speed = [&]<auto member>(const char* key, const char* flag, const char* what) {
        add_gcode_row<member>(t, key, flag,
                              {.unit = "mm/s",
                               .limits = speeds_or_none,
                               .help = std::string("Speed of ") + what + "; 0: print_speed."});
    };
    speed.operator()<&G::wall_speed>("wall_speed", "--printer-wall-speed", "outer walls");
    speed.operator()<&G::inner_wall_speed>("inner_wall_speed", "--printer-inner-wall-speed", "inner walls");
    speed.operator()<&G::infill_speed>("infill_speed", "--printer-infill-speed", "sparse infill");
    speed.operator()<&G::solid_speed>("solid_speed", "--printer-solid-speed", "solid infill");
    speed.operator()<&G::thin_speed>("thin_speed", "--printer-thin-speed", "thin beams and gaps");
    add_gcode_row<&G::bridge_speed>(
        t, "bridge_speed", "--printer-bridge-speed",
        {.unit = "mm/s",
         .limits = speeds_or_none,
         .help = "Speed of beads with nothing below them; 0: like supported beads."});
    add_gcode_row<&G::bridge_flow>(
        t, "bridge_flow", "--printer-bridge-flow",
        {.limits = {0.1, 5},
         .help = "Flow of beads with nothing below them, as a factor on the volume of the bead."});
    add_gcode_row<&G::bridge_fan>(
        t, "bridge_fan", "--printer-bridge-fan",
        {.limits = share, .help = "Minimum fan speed for beads with nothing below them."});
}

void add_travel(std::vector<Setting>& t) {
    using G = GcodeProfile;
    constexpr Limits lengths{0, 1e5};
    add_gcode_row<&G::travel_inside>(
        t, "travel_inside", "--printer-travel-inside",
        {.help = "Travel between beads of an island along the shortest path inside it, if there is one."});
    add_gcode_row<&G::retract_from>(
        t, "retract_from", "--printer-retract-from",
        {.unit = "mm",
         .limits = lengths,
         .help = "Retract on travel moves longer than this that leave the part."});
    add_gcode_row<&G::retract_inside_from>(
        t, "retract_inside_from", "--printer-retract-inside-from",
        {.unit = "mm",
         .limits = lengths,
         .help = "Retract on travel moves longer than this inside an island."});
    add_gcode_row<&G::wipe>(t, "wipe", "--printer-wipe",
                            {.unit = "mm",
                             .limits = {0, 100},
                             .help = "Length of the last bead retraced while retracting, as far as "
                                     "retraction_speed allows; 0: retract in place."});
    add_gcode_row<&G::z_hop>(t, "z_hop", "--printer-z-hop",
                             {.unit = "mm",
                              .limits = {0, 20},
                              .help = "Height by which the nozzle rises on travel moves with retraction."});
    add_gcode_row<&G::z_hop_from>(
        t, "z_hop_from", "--printer-z-hop-from",
        {.unit = "mm",
         .limits = lengths,
         .help = "Minimum length of a travel move with z_hop; shorter ones stay level."});
}

void add_motion(std::vector<Setting>& t) {
    using G = GcodeProfile;
    add_gcode_row<&G::acceleration>(t, "acceleration", "--printer-acceleration",
                                    {.unit = "mm/s^2",
                                     .limits = accelerations,
                                     .help = "Acceleration of the machine, for time estimates."});
    const auto acceleration = [&]<auto member>(const char* key, const char* flag, const char* what) {
        add_gcode_row<member>(t, key, flag,
                              {.unit = "mm/s^2",
                               .limits = accelerations_or_none,
                               .help = std::string("Acceleration set for ") + what + "; 0: acceleration."});
    };
    acceleration.operator()<&G::wall_acceleration>("wall_acceleration", "--printer-wall-acceleration",
                                                   "outer walls");
    acceleration.operator()<&G::travel_acceleration>("travel_acceleration", "--printer-travel-acceleration",
                                                     "moves without extrusion");
    acceleration.operator()<&G::first_layer_acceleration>(
        "first_layer_acceleration", "--printer-first-layer-acceleration", "the first layer");
    add_gcode_row<&G::junction_deviation>(t, "junction_deviation", "--printer-junction-deviation",
                                          {.unit = "mm",
                                           .limits = {0.001, 1},
                                           .help = "Junction deviation of the machine; for classic jerk or "
                                                   "square corner velocity j use 0.4 j^2 / acceleration."});
    add_gcode_row<&G::planner_blocks>(
        t, "planner_blocks", "--printer-planner-blocks",
        {.unit = "moves",
         .limits = {2, 1000},
         .help =
             "Number of moves in the machine's look-ahead planner; line rates are averaged over as many."});
    add_gcode_row<&G::lines_per_second>(
        t, "lines_per_second", "--printer-lines-per-second",
        {.limits = {0, 1e6},
         .help = "Lines per second that the machine can process: points are merged within the tolerance, and "
                 "moves that are still too dense are slowed down; 0: no limit."});
    add_gcode_row<&G::arcs>(
        t, "arcs", "--printer-arcs",
        {.help = "Write arcs (G2, G3) for points that lie on an arc within the tolerance."});
    add_gcode_row<&G::gantry_height>(
        t, "gantry_height", "--printer-gantry-height",
        {.unit = "mm",
         .limits = {0, 10000},
         .help = "Room below the gantry: the highest part that others may be printed beside, one by one."});
    add_gcode_row<&G::head_radius>(
        t, "head_radius", "--printer-head-radius",
        {.unit = "mm",
         .limits = {0, 1000},
         .help =
             "Reach of the print head around the nozzle: the least gap between parts printed one by one."});
    add_gcode_row<&G::label_objects>(
        t, "label_objects", "--printer-label-objects",
        {.help =
             "Say which of several parts on a plate the lines belong to, so that one can be cancelled (M486, "
             "EXCLUDE_OBJECT)."});
    add_gcode_row<&G::thumbnails>(t, "thumbnails", "--printer-thumbnails",
                                  {.help = "Put pictures of the part into the file, for hosts and displays; "
                                           "they are drawn before the first layer."});
}

void add_laser(std::vector<Setting>& t) {
    using L = LaserProfile;
    add_laser_row<&L::cut_power>(
        t, "cut_power", "--printer-cut-power",
        {.limits = share, .help = "Cutting power of a laser under grbl, as a share of full power."});
    add_laser_row<&L::engrave_power>(
        t, "engrave_power", "--printer-engrave-power",
        {.limits = share,
         .help = "Power for engraving numbers and scoring outlines, as a share of full power."});
    add_laser_row<&L::cut_speed>(t, "cut_speed", "--printer-cut-speed",
                                 {.unit = "mm/s", .limits = speeds, .help = "Speed of cutting under grbl."});
    add_laser_row<&L::engrave_speed>(
        t, "engrave_speed", "--printer-engrave-speed",
        {.unit = "mm/s", .limits = speeds, .help = "Speed of engraving and scoring under grbl."});
    add_laser_row<&L::power_steps>(
        t, "power_steps", "--printer-power-steps",
        {.limits = {1, 1'000'000}, .help = "Value of full power under grbl, its setting $30."});
    add_laser_row<&L::dynamic_power>(
        t, "dynamic_power", "--printer-dynamic-power",
        {.help = "Scale the power with the speed (M4) instead of constant power (M3)."});
    add_laser_row<&L::cut_passes>(
        t, "cut_passes", "--printer-cut-passes",
        {.limits = {1, 1000}, .help = "Number of passes along each cut of a laser under grbl."});
}

}  // namespace

void add_gcode_settings(std::vector<Setting>& table) {
    add_scripts(table);
    add_heat(table);
    add_speeds(table);
    add_travel(table);
    add_motion(table);
    add_laser(table);
}

}  // namespace lamella
