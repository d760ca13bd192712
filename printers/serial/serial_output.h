// Outputs of G-code to a machine on a serial line, and to a simulated machine (dry run).
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "printers/common/profile.h"
#include "printers/gcode/gcode_output.h"
#include "printers/serial/print_chunk.h"
#include "printers/serial/print_link.h"

namespace lamella {

struct SerialOutputOptions {
    bool force = false;         ///< discard the journal of an interrupted print
    std::optional<double> z{};  ///< height of the nozzle when a print is resumed; default: from the journal
    std::function<void(const std::string&)> warn{};  ///< called with warnings for the user
};

/// Sets dialect, parking position, height and motion limits of a printer of G-code.
void suit_printer(LinkSettings& settings, const PrinterProfile& printer);

/// Sets the dialect of a ready file or, with a printer, of its job, by the port: a socket is Klipper's.
/// `firmware` is marlin, grbl, klipper, or empty for that of the printer or the port. Without a port, as for
/// a dry run, only a named Klipper is one. Throws InputError where port, firmware and printer do not fit.
void choose_dialect(LinkSettings& settings, const std::string& firmware, const PrinterProfile* printer);

/// Makes an output that sends a job over a link. A layer is complete when the printer has answered all its
/// lines. A resumed print continues with the first incomplete layer: the printer is heated, X and Y are
/// homed, and Z is set from the journal.
std::unique_ptr<GcodeOutput> make_serial_output(std::shared_ptr<PrintLink> link, const LinkSettings& settings,
                                                SerialOutputOptions options);

/// Result of a dry run.
struct DryRun {
    std::int64_t lines = 0, bytes = 0;
    double seconds = 0;        ///< time of motion at the programmed speeds, without acceleration, s
    double model_seconds = 0;  ///< time of motion by the motion model, s
    LinkNeed need;
    double sending_seconds = 0;  ///< time that sending took here, to a machine that answers at once, s
};

/// Makes an output that sends a job to a simulated machine, which answers at once. Fills `report`.
std::unique_ptr<GcodeOutput> make_dry_run(const LinkSettings& settings, DryRun& report);

/// Returns a warning if the link is too slow for a job; empty if it is not.
std::string link_warning(const LinkNeed& need, int baud);

/// Sends an existing G-code file in parts: layers if comments mark them, otherwise blocks of lines. The whole
/// file is checked before the first line is sent. Returns the number of parts. Throws InputError, with the
/// line's number, for a line that cannot be sent, and for a file without any.
int send_gcode_file(const std::filesystem::path& path, GcodeOutput& output, bool resume,
                    const LinkSettings& settings);

}  // namespace lamella
