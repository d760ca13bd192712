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
        {.help = "Firmware whose words G-code is written in; grbl cuts layers with a laser."});
    add_gcode_row<&G::start_script>(
        t, "start_script", "--printer-start-script",
        {.fallback = "heat, home, wait for the heat",
         .help =
             "Lines at the start instead, with {nozzle_temperature}, {bed_temperature}, {layers} and so on.",
         .is_lines = true});
    add_gcode_row<&G::layer_script>(
        t, "layer_script", "--printer-layer-script",
        {.fallback = "none; under grbl a pause before the next sheet",
         .help = "Lines before each layer, with {layer}, {z}, {height} and so on.",
         .is_lines = true});
    add_gcode_row<&G::end_script>(t, "end_script", "--printer-end-script",
                                  {.fallback = "all off",
                                   .help = "Lines at the end instead, with {filament_used}, {z} and so on.",
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
         .help = "Temperature of the nozzle for the first layer; 0: as for the others."});
    add_gcode_row<&G::first_layer_bed_temperature>(
        t, "first_layer_bed_temperature", "--printer-first-layer-bed-temperature",
        {.unit = "degrees Celsius",
         .limits = {0, 250},
         .help = "Temperature of the bed for the first layer; 0: as for the others."});
    add_gcode_row<&G::fan>(
        t, "fan", "--printer-fan",
        {.limits = share, .help = "Speed of the fan that cools the part, as a share of all."});
    add_gcode_row<&G::fan_off_layers>(
        t, "fan_off_layers", "--printer-fan-off-layers",
        {.unit = "layers", .limits = {0, 1e6}, .help = "First layers that are printed without fan."});
    add_gcode_row<&G::fan_ramp_layers>(
        t, "fan_ramp_layers", "--printer-fan-ramp-layers",
        {.unit = "layers", .limits = {0, 1e6}, .help = "Layers over which the fan then comes to its speed."});
    add_gcode_row<&G::min_layer_time>(
        t, "least_layer_time", "--printer-least-layer-time",
        {.unit = "s", .limits = {0, 3600}, .help = "Layers that would take less are slowed down."});
    add_gcode_row<&G::min_speed>(
        t, "least_speed", "--printer-least-speed",
        {.unit = "mm/s", .limits = speeds, .help = "Speed below which no layer is slowed down for that."});
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
         .help = "Speed of beads with nothing under them; 0: as if they were held."});
    add_gcode_row<&G::bridge_flow>(
        t, "bridge_flow", "--printer-bridge-flow",
        {.limits = {0.1, 5},
         .help = "Plastic of beads with nothing under them, over what fills their volume."});
    add_gcode_row<&G::bridge_fan>(
        t, "bridge_fan", "--printer-bridge-fan",
        {.limits = share, .help = "Least speed of the fan over beads with nothing under them."});
}

void add_travel(std::vector<Setting>& t) {
    using G = GcodeProfile;
    constexpr Limits lengths{0, 1e5};
    add_gcode_row<&G::travel_inside>(
        t, "travel_inside", "--printer-travel-inside",
        {.help = "Go from bead to bead of an island inside it, the shortest way, where there is one."});
    add_gcode_row<&G::retract_from>(t, "retract_from", "--printer-retract-from",
                                    {.unit = "mm",
                                     .limits = lengths,
                                     .help = "Filament is drawn back on longer ways that leave the part."});
    add_gcode_row<&G::retract_inside_from>(
        t, "retract_inside_from", "--printer-retract-inside-from",
        {.unit = "mm", .limits = lengths, .help = "Filament is drawn back on longer ways inside an island."});
    add_gcode_row<&G::wipe>(t, "wipe", "--printer-wipe",
                            {.unit = "mm",
                             .limits = {0, 100},
                             .help = "Way along the last bead on which filament is drawn back, as much as "
                                     "retraction_speed allows; 0: in place."});
    add_gcode_row<&G::z_hop>(
        t, "z_hop", "--printer-z-hop",
        {.unit = "mm",
         .limits = {0, 20},
         .help = "By how much the nozzle rises on ways on which filament is drawn back."});
    add_gcode_row<&G::z_hop_from>(
        t, "z_hop_from", "--printer-z-hop-from",
        {.unit = "mm", .limits = lengths, .help = "Shorter ones of these ways are made without rising."});
}

void add_motion(std::vector<Setting>& t) {
    using G = GcodeProfile;
    add_gcode_row<&G::acceleration>(t, "acceleration", "--printer-acceleration",
                                    {.unit = "mm/s^2",
                                     .limits = accelerations,
                                     .help = "Acceleration of the machine, by which times are estimated."});
    const auto acceleration = [&]<auto member>(const char* key, const char* flag, const char* what) {
        add_gcode_row<member>(
            t, key, flag,
            {.unit = "mm/s^2",
             .limits = accelerations_or_none,
             .help = std::string("Acceleration that is set for ") + what + "; 0: acceleration."});
    };
    acceleration.operator()<&G::wall_acceleration>("wall_acceleration", "--printer-wall-acceleration",
                                                   "outer walls");
    acceleration.operator()<&G::travel_acceleration>("travel_acceleration", "--printer-travel-acceleration",
                                                     "moves without extrusion");
    acceleration.operator()<&G::first_layer_acceleration>(
        "first_layer_acceleration", "--printer-first-layer-acceleration", "the first layer");
    add_gcode_row<&G::junction_deviation>(
        t, "junction_deviation", "--printer-junction-deviation",
        {.unit = "mm",
         .limits = {0.001, 1},
         .help = "Junction deviation of the machine; of classic jerk or square corner velocity j: 0.4 j^2 / "
                 "acceleration."});
    add_gcode_row<&G::planner_blocks>(
        t, "planner_blocks", "--printer-planner-blocks",
        {.unit = "moves",
         .limits = {2, 1000},
         .help = "Moves that the machine looks ahead; rates of lines are theirs."});
    add_gcode_row<&G::lines_per_second>(
        t, "lines_per_second", "--printer-lines-per-second",
        {.limits = {0, 1e6},
         .help =
             "Lines a second that the machine can take: points are merged within the tolerance, and what is "
             "still too fast is slowed down; 0: any."});
    add_gcode_row<&G::arcs>(t, "arcs", "--printer-arcs",
                            {.help = "Make arcs (G2, G3) of points that lie on one within the tolerance."});
    add_gcode_row<&G::thumbnails>(
        t, "thumbnails", "--printer-thumbnails",
        {.help = "Put pictures of the part into the file, for hosts and displays; drawing "
                 "them comes before the first layer."});
}

void add_laser(std::vector<Setting>& t) {
    using L = LaserProfile;
    add_laser_row<&L::cut_power>(
        t, "cut_power", "--printer-cut-power",
        {.limits = share, .help = "Power of a laser under grbl when it cuts, as a share of all."});
    add_laser_row<&L::engrave_power>(
        t, "engrave_power", "--printer-engrave-power",
        {.limits = share, .help = "The same when it engraves numbers and scores outlines."});
    add_laser_row<&L::cut_speed>(t, "cut_speed", "--printer-cut-speed",
                                 {.unit = "mm/s", .limits = speeds, .help = "Speed of cutting under grbl."});
    add_laser_row<&L::engrave_speed>(
        t, "engrave_speed", "--printer-engrave-speed",
        {.unit = "mm/s", .limits = speeds, .help = "Speed of engraving and scoring under grbl."});
    add_laser_row<&L::power_steps>(
        t, "power_steps", "--printer-power-steps",
        {.limits = {1, 1'000'000}, .help = "Number that means full power under grbl, its setting $30."});
    add_laser_row<&L::dynamic_power>(
        t, "dynamic_power", "--printer-dynamic-power",
        {.help = "Power that follows the speed (M4) instead of constant power (M3)."});
    add_laser_row<&L::cut_passes>(
        t, "cut_passes", "--printer-cut-passes",
        {.limits = {1, 1000}, .help = "Times that a laser under grbl goes along each cut."});
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
