// From G-code text to lines ready to send, and what they ask of the link.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "printers/serial/gcode_line.h"
#include "printers/serial/grbl_modes.h"
#include "printers/serial/machine_state.h"

namespace lamella {

/// How many lines and bytes a second a job needs at its densest.
struct LinkNeed {
    double lines = 0;  ///< a second
    double bytes = 0;  ///< a second, with numbers and checksums
};

/// Strips a job's text, layer by layer, and follows the machine through it.
class ChunkMaker {
  public:
    explicit ChunkMaker(bool grbl) : grbl_(grbl) {}

    /// Clean lines of a text, each with its end. Throws InputError for a line that cannot be sent.
    std::string clean(std::string_view text);
    std::int64_t lines() const { return lines_; }
    /// Wire bytes of all lines so far.
    std::int64_t bytes() const { return bytes_; }
    /// Time of all motion so far at the speeds asked for, s.
    double seconds() const { return seconds_; }
    /// The densest stretch of at least a second so far.
    const LinkNeed& need() const { return need_; }
    /// What the machine does behind all lines so far: of these, the one that is followed.
    const MachineState& machine() const { return machine_; }
    const GrblModes& grbl_modes() const { return modes_; }
    nlohmann::ordered_json machine_to_json() const { return grbl_ ? modes_.to_json() : machine_.to_json(); }
    /// Throws nlohmann::json::exception when something is missing.
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
