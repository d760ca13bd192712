// GcodeProfile and LaserProfile: dialect, scripts, speeds, motion and laser of a machine that runs G-code.
#pragma once

#include <string>

namespace lamella {

/// Firmware whose dialect a G-code file is written in.
enum class Flavour : unsigned char {
    marlin,
    klipper,
    reprapfirmware,
    grbl  ///< lasers: layers are cut, not printed
};

/// Lengths in mm, speeds in mm/s, accelerations in mm/s^2.
struct GcodeProfile {
    Flavour flavour = Flavour::marlin;
    /// Scripts with variables in braces (see gcode_script.h); empty: the default scripts of the flavour.
    std::string start_script, layer_script, end_script, tool_script;
    bool prime_line = true;                     ///< prime the nozzle along the bed's front edge
    double first_layer_nozzle_temperature = 0;  ///< degrees Celsius; 0: as for the other layers
    double first_layer_bed_temperature = 0;     ///< degrees Celsius; 0: as for the other layers
    double fan = 1;                             ///< fan speed, as a share of full speed
    int fan_off_layers = 1;                     ///< number of first layers without fan
    int fan_ramp_layers = 0;                    ///< number of layers over which the fan then speeds up
    double min_layer_time = 0;                  ///< least time of a layer, s; faster layers are slowed down
    double min_speed = 10;                      ///< speed below which no layer is slowed down
    double wall_speed = 0, inner_wall_speed = 0, infill_speed = 0, solid_speed = 0,
           thin_speed = 0;      ///< speeds by role of the bead; 0: print_speed
    double bridge_speed = 0;    ///< speed of bridging beads; 0: as for supported beads
    double bridge_flow = 1;     ///< extruded volume of bridging beads, relative to their cross-section
    double bridge_fan = 0;      ///< least fan speed while bridging, as a share of full speed
    bool travel_inside = true;  ///< travel between beads of one island inside the island where possible
    double retract_from = 2;    ///< least length of a travel outside the part that retracts the filament
    double retract_inside_from = 10;  ///< least length of a travel inside an island that retracts
    double wipe = 0;        ///< length of the last bead along which the nozzle is wiped during retraction
    double z_hop = 0;       ///< rise of the nozzle during a retracted travel
    double z_hop_from = 0;  ///< least length of a travel with z_hop
    double acceleration = 1000;  ///< default acceleration of the machine
    double wall_acceleration = 0, travel_acceleration = 0, first_layer_acceleration = 0;  ///< 0: default
    double junction_deviation = 0.013;  ///< of corners; for classic jerk j: 0.4 j^2 / acceleration
    int planner_blocks = 16;            ///< moves in the machine's look-ahead buffer
    double lines_per_second = 0;        ///< highest rate of lines that the machine can take; 0: unlimited
    double gantry_height = 25;          ///< room for parts below the gantry while the nozzle is on the bed
    double head_radius = 35;            ///< reach of the print head around the nozzle below that height
    bool label_objects = true;  ///< say which part of a plate each line belongs to, for cancelling one
    bool thumbnails = false;    ///< embed pictures of the part for hosts; they must be rendered first
    bool arcs = false;          ///< emit G2 and G3 where an arc fits within the tolerance
};

/// How a GRBL laser cuts layers.
struct LaserProfile {
    double cut_power = 1;        ///< share of full power
    double engrave_power = 0.3;  ///< power for numbers and scored lines, as a share of full power
    double cut_speed = 10;       ///< mm/s
    double engrave_speed = 50;   ///< mm/s
    int power_steps = 1000;      ///< S word of full power, $30
    bool dynamic_power = true;   ///< power that follows the speed (M4) instead of constant power (M3)
    int cut_passes = 1;          ///< passes along each cut
};

}  // namespace lamella
