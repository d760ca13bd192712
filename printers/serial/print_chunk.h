// ChunkMaker: turns G-code text into lines ready to send, and measures the required link speed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "printers/serial/gcode_line.h"
#include "printers/serial/grbl_modes.h"
#include "printers/serial/machine_state.h"

namespace lamella {

/// Highest rate of lines and bytes of a job.
struct LinkNeed {
    double lines = 0;  ///< lines per second
    double bytes = 0;  ///< bytes per second, including numbers and checksums
};

/// Strips the text of a job, layer by layer, and tracks the state of the machine.
class ChunkMaker {
  public:
    explicit ChunkMaker(bool grbl) : grbl_(grbl) {}

    /// Returns the clean lines of a text, each with a line end. Throws InputError for a line that cannot be
    /// sent.
    std::string clean(std::string_view text);
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
    nlohmann::ordered_json machine_to_json() const { return grbl_ ? modes_.to_json() : machine_.to_json(); }
    /// Throws nlohmann::json::exception if a field is missing.
    void restore_machine(const nlohmann::ordered_json& json);

  private:
    bool grbl_;
    MachineState machine_;
    GrblModes modes_;
    std::int64_t lines_ = 0, bytes_ = 0;
    double seconds_ = 0;
    double stretch_ = 0;
    std::int64_t stretch_lines_ = 0, stretch_bytes_ = 0;
    LinkNeed need_;
};

}  // namespace lamella
