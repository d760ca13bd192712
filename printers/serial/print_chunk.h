// From G-code text to lines ready to send, and what they ask of the link.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

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
    explicit ChunkMaker(std::size_t longest) : longest_(longest) {}

    /// Clean lines of a text, each with its end. Throws InputError for a line that cannot be sent.
    std::string clean(std::string_view text);
    std::int64_t lines() const { return lines_; }
    /// Wire bytes of all lines so far.
    std::int64_t bytes() const { return bytes_; }
    /// Time of all motion so far at the speeds asked for, s.
    double seconds() const { return seconds_; }
    /// The densest stretch of at least a second so far.
    const LinkNeed& need() const { return need_; }
    /// What the machine does behind all lines so far.
    const MachineState& machine() const { return machine_; }
    void set_machine(const MachineState& machine) { machine_ = machine; }

  private:
    std::size_t longest_;
    MachineState machine_;
    std::int64_t lines_ = 0, bytes_ = 0;
    double seconds_ = 0;
    double stretch_ = 0;
    std::int64_t stretch_lines_ = 0, stretch_bytes_ = 0;
    LinkNeed need_;
};

}  // namespace lamella
