// `lamella print`: computes a recipe's layers and sends them to a machine at the same time. `lamella ports`.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/print_texts.h"
#include "app/console/print_view.h"
#include "app/console/text_output.h"
#include "app/reports/empty_job.h"
#include "engine/base/error.h"
#include "printers/archive/output_file.h"
#include "printers/gcode/gcode.h"
#include "printers/registry.h"
#include "printers/serial/klipper_socket.h"
#include "printers/serial/serial_output.h"

namespace lamella {

namespace {

struct PrintOptions : JobOptions {
    LinkSettings link;
    std::string firmware;  ///< see choose_dialect
    std::vector<double> park;
    std::optional<double> z;
    bool dry_run = false;
    bool force = false;
    bool stop_on_hangup = false;
    std::string repeat;  ///< the command line that continues this print
};

bool is_gcode_file(const std::string& input) {
    for (const char* ending : {".gcode", ".gco", ".g", ".nc", ".ngc"}) {
        if (input.ends_with(ending)) return true;
    }
    return false;
}

void say(const PrintOptions& options, const std::string& text) {
    if (!options.quiet) std::fputs((text + "\n").c_str(), stderr);
}

/// Prints layers as they are computed, or a ready file.
void produce(const PrintOptions& options, const std::optional<Recipe>& recipe,
             const std::optional<PreparedJob>& prepared, std::unique_ptr<GcodeOutput> output) {
    if (!recipe) {
        send_gcode_file(options.recipe.input(), *output, options.resume, options.link);
        return;
    }
    const auto backend = make_gcode(recipe->printer, std::move(output));
    const StreamReport report = stream_layers(prepared->built.job, *backend, prepared->stream);
    const std::string empty = empty_job_text(*recipe, prepared->built.job, report);
    if (!empty.empty()) throw InputError(empty);
    for (const std::string& note : backend->notes()) say(options, "note: " + note);
}

void dry_run(const PrintOptions& options, const std::optional<Recipe>& recipe,
             const std::optional<PreparedJob>& prepared) {
    DryRun report;
    produce(options, recipe, prepared, make_dry_run(options.link, report));
    TextOutput out("");
    if (options.link.dialect == Dialect::klipper) {
        out.write(fmt::format(
            "{} lines, {} bytes in scripts: {:.0f} s of motion at the speeds asked for, {:.0f} "
            "s with acceleration\nat its densest {:.0f} lines/s\nsent to a Klipper that "
            "answers at once: {:.0f} lines/s\n",
            report.lines, report.bytes, report.seconds, report.model_seconds, report.need.lines,
            report.sending_seconds > 0 ? static_cast<double>(report.lines) / report.sending_seconds : 0));
        return out.close();
    }
    const double wire = static_cast<double>(report.bytes) * 10 / options.link.baud;
    out.write(fmt::format(
        "{} lines, {} bytes: {:.0f} s of motion at the speeds asked for, {:.0f} s with acceleration, "
        "{:.0f} s on a wire of {} baud\n"
        "at its densest {:.0f} lines/s and {:.0f} bytes/s of {:.0f}\n"
        "sent to a machine that answers at once: {:.0f} lines/s\n",
        report.lines, report.bytes, report.seconds, report.model_seconds, wire, options.link.baud,
        report.need.lines, report.need.bytes, options.link.baud / 10.0,
        report.sending_seconds > 0 ? static_cast<double>(report.lines) / report.sending_seconds : 0));
    out.close();
    if (const std::string warning = link_warning(report.need, options.link.baud); !warning.empty())
        say(options, warning);
}

void print(const PrintOptions& options, const std::optional<Recipe>& recipe,
           const std::optional<PreparedJob>& prepared) {
    const TerminalGuard terminal(options.stop_on_hangup);
    const auto link = std::make_shared<PrintLink>(options.link);
    PrintView view(link, prepared ? prepared->stream.range.last : 0, options.quiet);
    SerialOutputOptions output{options.force, options.z,
                               [&](const std::string& text) { view.show_message(text); }};
    const auto go_on = [&] {
        // Before the first layer is done there is nothing to go on from.
        const bool kept = link->status().resumable || is_present(options.link.journal);
        return kept ? ". To go on: " + options.repeat : std::string();
    };
    const auto sum_up = [&] {
        view.close();
        if (link->status().connected) say(options, summary_text(link->status()));
    };
    try {
        produce(options, recipe, prepared, make_serial_output(link, options.link, output));
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
        throw InputError(
            "--port: missing; accepted: the printer's serial port, such as /dev/ttyUSB0, or the API socket "
            "of "
            "Klipper; `lamella ports` lists them");
    const bool file = is_gcode_file(options.recipe.input());
    std::string name = options.recipe.input();
    std::optional<Recipe> recipe;
    std::optional<PreparedJob> prepared;
    if (!file) {
        recipe = options.recipe.read();
        if (!makes_beads(recipe->printer)) {
            throw InputError("the recipe's printer \"" + recipe->printer.name +
                             "\" does not use G-code (its kind is " + recipe->printer.backend +
                             "); accepted: a printer that does, such as --printer marlin");
        }
        name = recipe->part.name;
        suit_printer(options.link, recipe->printer);
        prepared = prepare_job(options, *recipe, cancel);
    }
    choose_dialect(options.link, options.firmware, recipe ? &recipe->printer : nullptr);
    if (!options.park.empty()) options.link.park_x = options.park[0], options.link.park_y = options.park[1];
    if (options.link.journal.empty()) options.link.journal = name + ".print.journal";
    if (options.dry_run) return dry_run(options, recipe, prepared);
    print(options, recipe, prepared);
}

void list_ports() {
    std::string text;
    for (const PortInfo& port : serial_ports()) {
        text += port.path;
        if (!port.description.empty()) text += "  " + port.description;
        if (!port.by_id.empty())
            text +=
                "\n"
                "    " +
                port.by_id;
        text += "\n";
    }
    for (const std::string& socket : klipper_sockets()) text += socket + "  API socket of Klipper\n";
    if (text.empty())
        text = "no serial port and no socket of Klipper found; is the printer plugged in and switched on?\n";
    TextOutput out("");
    out.write(text);
    out.close();
}

void add_link_options(CLI::App& command, PrintOptions& options) {
    LinkSettings& link = options.link;
    command.add_option("--port", link.port, "Serial port of the printer, or the API socket of Klipper")
        ->type_name("DEVICE")
        ->group("Printer");
    command.add_option("--baud", link.baud, "Speed of the serial line, baud; default: 250000")
        ->check(CLI::Range(1200, 4000000))
        ->group("Printer");
    command
        .add_option(
            "--firmware", options.firmware,
            "marlin, grbl or klipper; default: klipper for a socket, else that of the recipe's printer, "
            "marlin for a ready file")
        ->check(CLI::IsMember({"marlin", "grbl", "klipper"}))
        ->group("Printer");
    command
        .add_option("--send-window", link.sender.window,
                    "Bytes that may be sent ahead of the answers; default: 127")
        ->check(CLI::Range(64, 65536))
        ->group("Printer");
    command
        .add_flag("--ping-pong", link.sender.ping_pong,
                  "Send one line at a time, each after the answer to the last")
        ->group("Printer");
    command
        .add_flag("--within-slots", link.sender.within_slots,
                  "Send no more lines than the printer has free slots, if it reports them (ADVANCED_OK)")
        ->group("Printer");
    command
        .add_option("--greeting", link.sender.greeting,
                    "Seconds to wait for a board that resets when the port is opened; default: 3")
        ->check(CLI::Range(0.0, 60.0))
        ->group("Printer");
    command.add_flag("--reset", link.reset_board, "First reset the board through the DTR line")
        ->group("Printer");
    command.add_option("--reconnect", link.reconnect_for, "Seconds to wait for a lost port; default: 60")
        ->check(CLI::Range(0.0, 86400.0))
        ->group("Printer");
    command
        .add_option("--park", options.park,
                    "Position where the nozzle waits, X and Y in mm; default: the bed's rear left corner, "
                    "0,0 for a ready file")
        ->expected(2)
        ->delimiter(',')
        ->group("Printer");
    command
        .add_option("--log", link.log,
                    "File for a log of every line with its time and the number of unanswered bytes")
        ->type_name("FILE")
        ->group("Printer");
    command
        .add_option("--journal", link.journal,
                    "File with the state that --resume needs; default: NAME.print.journal")
        ->type_name("FILE")
        ->group("Printer");
    command
        .add_option("--resume-z", options.z,
                    "Height of the nozzle when a print is resumed, mm; default: from the journal")
        ->check(CLI::Range(0.0, 10000.0))
        ->group("Printer");
}

}  // namespace

void add_print_command(CLI::App& root, const std::vector<std::string>& arguments) {
    auto options = std::make_shared<PrintOptions>();
    options->repeat = resuming(arguments);
    CLI::App& command =
        *root.add_subcommand("print",
                             "Compute layers and print them at the same time, over a serial line or "
                             "Klipper's socket");
    options->recipe.add_to(command);
    command.get_option("INPUT")->description(
        "Recipe (.toml), model (.stl, .obj, .ply, .3mf) or ready G-code (.gcode, .gco, .g, .nc, .ngc)");
    add_link_options(command, *options);
    add_job_options(command, *options);
    CLI::Option* resume = command.add_flag("--resume", options->resume, "Continue a stopped print");
    command.get_option("--resume-z")->needs(resume);
    command.add_flag("--dry-run", options->dry_run, "Send everything to a simulated machine, and report");
    command.add_flag("--force", options->force, "Discard the journal of a stopped print");
    command
        .add_flag("--stop-on-hangup", options->stop_on_hangup,
                  "Stop the print when the terminal is closed; without it the print goes on without its view")
        ->group("Printer");
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(
        command,
        "  lamella print insole.toml --port /dev/ttyUSB0\n"
        "  lamella print insole.toml --port /dev/serial/by-id/usb-1a86_USB_Serial-if00-port0 --baud 115200\n"
        "  lamella print insole.toml --dry-run\n"
        "  lamella print ready.gcode --port /dev/ttyACM0 --log print.log\n"
        "  lamella print insole.toml --printer klipper --port ~/printer_data/comms/klippy.sock\n"
        "  lamella print engraving.nc --port /dev/ttyUSB0 --baud 115200 --firmware grbl\n"
        "Keys: p pauses, r resumes or tells a waiting printer that you are done, 1 to 9 press a button of "
        "what\n"
        "it asks, s stops, x halts at once. A closed terminal ends the view, not the print. Ctrl-C stops\n"
        "the print and switches its heaters off; the same command with --resume goes on with the first\n"
        "layer that was not done: it heats, homes X and Y, and takes Z from the journal. Without keys,\n"
        "kill -USR1 does what r does. Exit codes: 0 printed, 2 bad input, 3 the printer or the line failed,\n"
        "130 stopped.");
    command.callback([options] { run(*options); });
}

void add_ports_command(CLI::App& root) {
    CLI::App& command =
        *root.add_subcommand("ports", "List the serial ports and the sockets of Klipper of this computer");
    finish_command(command, "  lamella ports");
    command.callback([] { list_ports(); });
}

}  // namespace lamella
