// `lamella print`: computes a recipe's layers and sends them to a machine at the same time. `lamella ports`.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/print_view.h"
#include "app/console/text_output.h"
#include "engine/base/error.h"
#include "printers/gcode/gcode.h"
#include "printers/registry.h"
#include "printers/serial/serial_output.h"

namespace lamella {

namespace {

struct PrintOptions : JobOptions {
    LinkSettings link;
    std::string firmware;  ///< marlin or grbl; empty: as the recipe's printer, marlin for a ready file
    std::vector<double> park;
    std::optional<double> z;
    bool dry_run = false;
    bool force = false;
    std::string repeat;  ///< the command line that continues this print
};

bool is_gcode_file(const std::string& input) {
    for (const char* ending : {".gcode", ".gco", ".g", ".nc", ".ngc"}) {
        if (input.ends_with(ending)) return true;
    }
    return false;
}

/// Which of the two kinds of sender. Throws InputError where the recipe writes for another one.
bool is_grbl(const PrintOptions& options, const std::optional<Recipe>& recipe) {
    if (!recipe) return options.firmware == "grbl";
    const bool grbl = recipe->printer.gcode.flavour == Flavour::grbl;
    if (!options.firmware.empty() && grbl != (options.firmware == "grbl")) {
        throw InputError("--firmware " + options.firmware + " does not go with the printer's flavour; " +
                         (grbl ? "a laser under grbl takes no lines for Marlin"
                               : "pass --printer-flavour grbl to cut layers with a laser"));
    }
    return grbl;
}

void say(const PrintOptions& options, const std::string& text) {
    if (!options.quiet) std::fputs((text + "\n").c_str(), stderr);
}

/// Sends layers as they are computed, or a ready file.
void produce(const PrintOptions& options, const std::optional<Recipe>& recipe,
             const std::optional<PreparedJob>& prepared, std::unique_ptr<GcodeOutput> output,
             const CancelToken& cancel) {
    if (!recipe) {
        send_gcode_file(options.recipe.input(), *output, options.resume, &cancel);
        return;
    }
    const auto backend = make_gcode(recipe->printer, std::move(output));
    stream_layers(prepared->built.job, *backend, prepared->stream);
    for (const std::string& note : backend->notes()) say(options, "note: " + note);
}

void dry_run(const PrintOptions& options, const std::optional<Recipe>& recipe,
             const std::optional<PreparedJob>& prepared, const CancelToken& cancel) {
    DryRun report;
    produce(options, recipe, prepared, make_dry_run(options.link, report), cancel);
    const double wire = static_cast<double>(report.bytes) * 10 / options.link.baud;
    TextOutput out("");
    out.write(fmt::format(
        "{} lines, {} bytes: {:.0f} s of motion at the speeds asked for, {:.0f} s on a wire of {} baud\n"
        "at its densest {:.0f} lines/s and {:.0f} bytes/s of {:.0f}\n"
        "sent to a machine that answers at once: {:.0f} lines/s\n",
        report.lines, report.bytes, report.seconds, wire, options.link.baud, report.need.lines,
        report.need.bytes, options.link.baud / 10.0,
        report.sending_seconds > 0 ? static_cast<double>(report.lines) / report.sending_seconds : 0));
    out.close();
    if (const std::string warning = link_warning(report.need, options.link.baud); !warning.empty())
        say(options, warning);
}

void print(const PrintOptions& options, const std::optional<Recipe>& recipe,
           const std::optional<PreparedJob>& prepared, const CancelToken& cancel) {
    const auto link = std::make_shared<PrintLink>(options.link);
    PrintView view(link, prepared ? prepared->built.job.layer_count : 0, options.quiet);
    SerialOutputOptions output{options.force, options.z,
                               [&](const std::string& text) { view.show_message(text); }};
    const auto go_on = [&] {
        return link->status().lines_answered > 0 ? ". To go on: " + options.repeat : std::string();
    };
    const auto sum_up = [&] {
        view.close();
        if (link->status().connected) say(options, summary_text(link->status()));
    };
    try {
        produce(options, recipe, prepared, make_serial_output(link, options.link, output), cancel);
    } catch (const Interrupted&) {
        const std::string words = link->end_words();
        sum_up();
        throw Interrupted((words.empty() ? "interrupted" : words) + go_on());
    } catch (const FaultError& error) {
        sum_up();
        throw FaultError(error.what() + go_on());
    }
    sum_up();
}

void run(PrintOptions options) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    options.link.cancel = &cancel;
    if (options.link.port.empty() && !options.dry_run)
        throw InputError("--port: name the printer's port, such as /dev/ttyUSB0; `lamella ports` lists them");
    const bool file = is_gcode_file(options.recipe.input());
    std::string name = options.recipe.input();
    std::optional<Recipe> recipe;
    std::optional<PreparedJob> prepared;
    if (!file) {
        recipe = options.recipe.read();
        if (!makes_beads(recipe->printer)) {
            throw InputError("the recipe's printer \"" + recipe->printer.name +
                             "\" takes no G-code (its kind is " + recipe->printer.backend +
                             "); name one that does, such as --printer marlin");
        }
        name = recipe->part.name;
        const FilamentProfile& bed = recipe->printer.filament;
        options.link.park_y = bed.bed_y;
        options.link.highest = bed.bed_z;
        prepared = prepare_job(options, *recipe, cancel);
    }
    options.link.grbl = is_grbl(options, recipe);
    if (!options.park.empty()) options.link.park_x = options.park[0], options.link.park_y = options.park[1];
    if (options.link.journal.empty()) options.link.journal = name + ".print.journal";
    if (options.dry_run) return dry_run(options, recipe, prepared, cancel);
    print(options, recipe, prepared, cancel);
}

void list_ports() {
    std::string text;
    for (const PortInfo& port : serial_ports()) {
        text += port.path;
        if (!port.description.empty()) text += "  " + port.description;
        if (!port.by_id.empty()) text += "\n    " + port.by_id;
        text += "\n";
    }
    if (text.empty()) text = "no serial port found; is the printer plugged in and switched on?\n";
    TextOutput out("");
    out.write(text);
    out.close();
}

void add_link_options(CLI::App& command, PrintOptions& options) {
    LinkSettings& link = options.link;
    command.add_option("--port", link.port, "Serial port of the printer")
        ->type_name("DEVICE")
        ->group("Printer");
    command.add_option("--baud", link.baud, "Its speed; default: 250000")
        ->check(CLI::Range(1200, 4000000))
        ->group("Printer");
    command
        .add_option("--firmware", options.firmware,
                    "marlin or grbl; default: as the recipe says, marlin for a ready file")
        ->check(CLI::IsMember({"marlin", "grbl"}))
        ->group("Printer");
    command.add_option("--send-window", link.sender.window, "Bytes that may be unanswered; default: 127")
        ->check(CLI::Range(64, 65536))
        ->group("Printer");
    command.add_flag("--ping-pong", link.sender.ping_pong, "One line at a time")->group("Printer");
    command
        .add_flag("--within-slots", link.sender.within_slots,
                  "No more lines than the printer has slots for, where it tells (ADVANCED_OK)")
        ->group("Printer");
    command
        .add_option("--greeting", link.sender.greeting, "Seconds to wait for a board that resets; default: 3")
        ->check(CLI::Range(0.0, 60.0))
        ->group("Printer");
    command.add_flag("--reset", link.reset_board, "Reset the board by DTR first")->group("Printer");
    command.add_option("--reconnect", link.reconnect_for, "Seconds to wait for a lost port; default: 60")
        ->check(CLI::Range(0.0, 86400.0))
        ->group("Printer");
    command
        .add_option("--park", options.park,
                    "Where the nozzle waits, X and Y in mm; default: the bed's rear left corner, 0,0 for a "
                    "ready file")
        ->expected(2)
        ->delimiter(',')
        ->group("Printer");
    command.add_option("--log", link.log, "File for every line with its time and the bytes then unanswered")
        ->type_name("FILE")
        ->group("Printer");
    command
        .add_option("--journal", link.journal, "File that lets a print go on; default: NAME.print.journal")
        ->type_name("FILE")
        ->group("Printer");
    command
        .add_option("--resume-z", options.z,
                    "Height of the nozzle when a print is resumed, mm; default: journaled")
        ->check(CLI::Range(0.0, 10000.0))
        ->group("Printer");
}

}  // namespace

void add_print_command(CLI::App& root, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<PrintOptions>();
    options->repeat = resuming(arguments);
    CLI::App& command =
        *root.add_subcommand("print", "Compute layers and print them at the same time, over a serial line");
    options->recipe.add_to(command);
    command.get_option("INPUT")->description(
        "Recipe (.toml), model (.stl, .obj, .ply, .3mf) or ready G-code (.gcode, .gco, .g, .nc, .ngc)");
    add_link_options(command, *options);
    add_job_options(command, *options);
    command.add_flag("--resume", options->resume, "Go on with a print that was stopped");
    command.add_flag("--dry-run", options->dry_run,
                     "Send everything to a machine that is only imagined, and report");
    command.add_flag("--force", options->force, "Forget a print that was stopped");
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(
        command,
        "  lamella print insole.toml --port /dev/ttyUSB0\n"
        "  lamella print insole.toml --port /dev/serial/by-id/usb-1a86_USB_Serial-if00-port0 --baud 115200\n"
        "  lamella print insole.toml --dry-run\n"
        "  lamella print ready.gcode --port /dev/ttyACM0 --log print.log\n"
        "  lamella print engraving.nc --port /dev/ttyUSB0 --baud 115200 --firmware grbl\n"
        "Keys: p pauses, r resumes or tells a waiting printer that you are done, 1 to 9 press a button of "
        "what\n"
        "it asks, s stops, x halts at once. Ctrl-C stops the print and switches its heaters off; the same\n"
        "command with --resume goes on with the first layer that was not done: it heats, homes X and Y, and\n"
        "takes Z from the journal. Exit codes: 0 printed, 2 bad input, 3 the printer or the line failed,\n"
        "130 stopped.");
    command.callback([options] { run(*options); });
}

void add_ports_command(CLI::App& root) {
    CLI::App& command = *root.add_subcommand("ports", "List the serial ports of this computer");
    finish_command(command, "  lamella ports");
    command.callback([] { list_ports(); });
}

}  // namespace lamella
