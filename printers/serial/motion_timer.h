// MotionTimer: the time that each line of a job takes, by the motion model.
#pragma once

#include <string_view>
#include <vector>

#include "printers/gcode/motion_model.h"
#include "printers/serial/grbl_modes.h"
#include "printers/serial/machine_state.h"

namespace lamella {

/// What a machine's motion is limited by. Lengths in mm, speeds in mm/s, accelerations in mm/s^2.
struct MotionLimits {
    double acceleration = 1000;         ///< of printing moves, until M204 says otherwise
    double travel_acceleration = 1000;  ///< of travels, until M204 says otherwise
    double junction_deviation = 0.013;
    double rapid_speed = 50;  ///< of G0 under GRBL, which does not tell it
};

/// Follows a job line by line. Travels, beads, arcs and dwells take time; heating, homing and waits take
/// none.
class MotionTimer {
  public:
    explicit MotionTimer(MotionLimits limits) : limits_(limits) {}

    /// Takes a clean line of Marlin, after which the machine's state is `after`.
    void add(std::string_view command, const MachineState& after);
    /// Takes a clean line of GRBL, after which its modes are `after`.
    void add(std::string_view command, const GrblModes& after);
    /// Returns the times of the lines taken since the last call, s. The machine is taken to stand still at
    /// the end.
    std::vector<float> take();

  private:
    struct Position {
        double x = 0, y = 0, z = 0, e = 0;
    };
    struct Arc {
        double i = 0, j = 0, r = 0;
        bool by_radius = false, clockwise = false;
    };
    void move(const Position& to, double speed, double acceleration, const Arc* arc);
    void stand(double seconds);

    MotionLimits limits_;
    Position at_;
    std::vector<MotionMove> moves_;
    std::vector<std::size_t> line_of_move_;
    std::vector<float> seconds_;  // of the lines so far; moves are added by take
    bool stands_ = true;          // the next move begins at standstill
};

}  // namespace lamella
