// G-code to a machine at the other end of a serial line, or to one that is only imagined.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "printers/gcode/gcode_output.h"
#include "printers/serial/print_chunk.h"
#include "printers/serial/print_link.h"

namespace lamella {

struct SerialOutputOptions {
    bool force = false;         ///< discard the journal of a print that was stopped
    std::optional<double> z{};  ///< where the nozzle stands when a print is taken up; else as journaled
    std::function<void(const std::string&)> warn{};  ///< of what the user should know beforehand
};

/// Sends to a link. Layers are done when the printer has answered all their lines. A print that is taken up
/// goes on with the first layer that was not: heated, homed in X and Y alone, its height set from the
/// journal.
std::unique_ptr<GcodeOutput> make_serial_output(std::shared_ptr<PrintLink> link, const LinkSettings& settings,
                                                SerialOutputOptions options);

/// What a print would send.
struct DryRun {
    std::int64_t lines = 0, bytes = 0;
    double seconds = 0;  ///< of motion at the speeds asked for, acceleration not counted
    LinkNeed need;
    double sending_seconds = 0;  ///< that a machine which answers at once took here
};

/// Goes through everything against a machine that answers at once; fills `report`.
std::unique_ptr<GcodeOutput> make_dry_run(const LinkSettings& settings, DryRun& report);

/// Whether the link is too slow for a job, in words; empty when it is not.
std::string link_warning(const LinkNeed& need, int baud);

/// Sends a ready file, layer by layer where its comments tell them, else in stretches of lines. Returns the
/// number of its parts.
int send_gcode_file(const std::filesystem::path& path, GcodeOutput& output, bool resume,
                    const CancelToken* cancel);

}  // namespace lamella
