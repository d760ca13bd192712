// ChunkMaker: turns G-code text into lines ready to send, and measures the required link speed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "printers/serial/gcode_line.h"
#include "printers/serial/grbl_modes.h"
#include "printers/serial/machine_state.h"
#include "printers/serial/motion_timer.h"

namespace lamella {

/// Highest rate of lines and bytes of a job.
struct LinkNeed {
    double lines = 0;  ///< lines per second
    double bytes = 0;  ///< bytes per second, including numbers and checksums
};

/// What is known of a line beside its text.
struct LineFacts {
    float seconds = 0;        ///< time of its motion by the motion model
    std::int32_t source = 0;  ///< number of the line in the job's text, from 1; 0: it has none
};

struct CleanText {
    std::string lines;             ///< each with a line end
    std::vector<LineFacts> facts;  ///< of each line
};

/// Strips the text of a job, layer by layer, and tracks the state of the machine.
class ChunkMaker {
  public:
    explicit ChunkMaker(Dialect dialect, const MotionLimits& limits = {})
        : dialect_(dialect), timer_(limits) {}

    /// Returns the lines of a text that are to be sent. Throws InputError, with the line's number in the
    /// job's text, for one that cannot be sent.
    CleanText clean(std::string_view text);
    /// Counts the lines of a part of the job that is not sent.
    void skip(std::string_view text);
    std::int64_t lines() const { return lines_; }
    /// Returns the bytes of all lines so far on the wire.
    std::int64_t bytes() const { return bytes_; }
    /// Returns the time of all motion so far at the programmed speeds, s.
    double seconds() const { return seconds_; }
    /// Returns the highest rates over any stretch of at least a second so far.
    const LinkNeed& need() const { return need_; }
    /// The state after all lines so far. Only the one of the job's dialect is tracked.
    const MachineState& machine() const { return machine_; }
    const GrblModes& grbl_modes() const { return modes_; }
    nlohmann::ordered_json machine_to_json() const {
        return is_grbl() ? modes_.to_json() : machine_.to_json();
    }
    /// Throws nlohmann::json::exception if a field is missing or none of a machine.
    void restore_machine(const nlohmann::ordered_json& json);

  private:
    bool is_grbl() const { return dialect_ == Dialect::grbl; }

    Dialect dialect_;
    MachineState machine_;
    GrblModes modes_;
    MotionTimer timer_;
    std::int32_t source_ = 0;
    std::int64_t lines_ = 0, bytes_ = 0;
    double seconds_ = 0;
    double stretch_ = 0;
    std::int64_t stretch_lines_ = 0, stretch_bytes_ = 0;
    LinkNeed need_;
};

}  // namespace lamella
