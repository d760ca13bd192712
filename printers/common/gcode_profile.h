// What a recipe says about G-code besides the nozzle and the bed: dialect, scripts, speeds, motion, laser.
#pragma once

#include <string>

namespace lamella {

/// Whose words a G-code file is written in.
enum class Flavour : unsigned char {
    marlin,
    klipper,
    reprapfirmware,
    grbl  ///< lasers: layers are cut, not printed
};

/// Lengths in mm, speeds in mm/s, accelerations in mm/s^2.
struct GcodeProfile {
    Flavour flavour = Flavour::marlin;
    /// Lines with variables in braces (see gcode_script.h); empty: the flavour's own.
    std::string start_script, layer_script, end_script;
    bool prime_line = true;                     ///< fill the nozzle along the bed's front edge
    double first_layer_nozzle_temperature = 0;  ///< degrees Celsius; 0: as the other layers
    double first_layer_bed_temperature = 0;     ///< degrees Celsius; 0: as the other layers
    double fan = 1;                             ///< share of its full speed
    int fan_off_layers = 1;                     ///< first layers without fan
    int fan_ramp_layers = 0;                    ///< over which it then comes to its speed
    double min_layer_time = 0;                  ///< s; layers that would be faster are slowed down
    double min_speed = 10;                      ///< below which no layer is slowed down
    double wall_speed = 0, inner_wall_speed = 0, infill_speed = 0, solid_speed = 0,
           thin_speed = 0;      ///< of beads by what they are for; 0: print_speed
    double bridge_speed = 0;    ///< of beads over the void; 0: as if they were held
    double bridge_flow = 1;     ///< plastic of beads over the void, over what fills their volume
    double bridge_fan = 0;      ///< least speed of the fan over the void, as a share of all
    bool travel_inside = true;  ///< between beads of an island stay inside it where that can be
    double retract_from = 2;    ///< length of a travel outside the part from which filament is drawn back
    double retract_inside_from = 10;  ///< the same where the travel stays over the island
    double wipe = 0;                  ///< length along the last bead while filament is drawn back
    double z_hop = 0;                 ///< by which the nozzle rises while filament is drawn back
    double z_hop_from = 0;            ///< length of a travel from which it does so
    double acceleration = 1000;       ///< that the machine has by itself
    double wall_acceleration = 0, travel_acceleration = 0, first_layer_acceleration = 0;  ///< 0: as that
    double junction_deviation = 0.013;  ///< of corners; for classic jerk j 0.4 j^2 / acceleration
    int planner_blocks = 16;            ///< moves that the machine looks ahead
    double lines_per_second = 0;        ///< that the machine can take; 0: any
    bool thumbnails = false;            ///< pictures of the part for hosts, at the cost of drawing them first
    bool arcs = false;                  ///< G2 and G3 where they fit within the tolerance
};

/// How a laser under GRBL cuts layers.
struct LaserProfile {
    double cut_power = 1;        ///< share of the full power
    double engrave_power = 0.3;  ///< the same, of numbers and scored lines
    double cut_speed = 10;       ///< mm/s
    double engrave_speed = 50;   ///< mm/s
    int power_steps = 1000;      ///< the S word of full power, $30
    bool dynamic_power = true;   ///< power that follows the speed (M4) instead of constant power (M3)
    int cut_passes = 1;          ///< times that each cut is gone along
};

}  // namespace lamella
