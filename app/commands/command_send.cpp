// `lamella send`: a recipe's output, or a ready file, to a printer on the network.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/console/interrupt.h"
#include "app/console/progress.h"
#include "app/console/text_output.h"
#include "app/jobs/job_upload.h"
#include "app/reports/empty_job.h"
#include "engine/base/error.h"
#include "hosts/known_hosts.h"
#include "hosts/send_upload.h"
#include "printers/registry.h"

namespace lamella {

namespace {

struct SendOptions : JobOptions {
    std::string host;
    SendSettings sending;
    bool no_spool = false;
    bool json = false;
};

bool is_recipe_or_model(const std::string& input) {
    return input.empty() ||
           std::ranges::any_of(std::initializer_list<const char*>{".toml", ".stl", ".obj", ".ply", ".3mf"},
                               [&](const char* ending) { return input.ends_with(ending); });
}

void say(const SendOptions& options, const std::string& text) {
    if (!options.quiet) std::fputs((text + "\n").c_str(), stderr);
}

/// One run of the command.
class Send {
  public:
    explicit Send(SendOptions& options)
        : options_(options),
          guard_(cancel_),
          known_(find_host(options.host)),
          host_(known_.connect(&cancel_)) {
        options_.sending.cancel = &cancel_;
        options_.sending.on_note = [this](const std::string& text) { say(options_, text); };
        if (host_->is_plain()) say(options_, known_.access.name + ": nothing is encrypted on the way there");
    }

    void run() {
        greet_host(*host_, options_.sending);
        const std::string& input = options_.recipe.input();
        if (is_recipe_or_model(input))
            send_job();
        else
            send_file(input, std::filesystem::path(input).stem().string());
    }

  private:
    void send_job() {
        const Recipe recipe = options_.recipe.read();
        const BackendInfo& backend = find_backend(recipe.printer.backend);
        const std::string ending =
            std::string(backend.endings).substr(0, std::string(backend.endings).find(' '));
        if (backend.output == OutputKind::folder || ending.empty()) {
            throw InputError(
                fmt::format("the printer \"{}\" makes a folder, which no host takes; accepted: a printer "
                            "that makes a file, such as --printer marlin",
                            recipe.printer.name));
        }
        const bool streams = host_->needs() == UploadNeeds::nothing || options_.no_spool;
        if (options_.no_spool && !can_stream(recipe.printer))
            throw InputError(
                "--no-spool: only G-code can be computed while it is sent; accepted: no --no-spool, and the "
                "file is written to disk first");
        PreparedJob prepared = prepare_job(options_, recipe, cancel_);
        if (options_.sending.name.empty())
            options_.sending.name =
                upload_name(recipe.part.name, upload_hash(prepared.built.job, prepared.stream.range), ending);
        if (streams && can_stream(recipe.printer))
            stream_job(recipe, prepared);
        else
            spool_job(recipe, prepared);
    }

    void stream_job(const Recipe& recipe, const PreparedJob& prepared) {
        ProgressDisplay display(options_.quiet, host_->needs() == UploadNeeds::nothing ? "sending: " : "");
        StreamOptions stream = prepared.stream;
        stream.on_progress = [&](const Progress& progress) { display.show(progress); };
        const auto source = stream_upload(recipe, prepared.built.job, stream);
        if (host_->needs() != UploadNeeds::nothing) source->count(&cancel_);
        finish(*source, display);
    }

    void spool_job(const Recipe& recipe, const PreparedJob& prepared) {
        const SpooledUpload spooled(options_.sending.name);
        {
            ProgressDisplay display(options_.quiet);
            StreamOptions stream = prepared.stream;
            stream.on_progress = [&](const Progress& progress) { display.show(progress); };
            const auto backend = make_backend(recipe.printer, spooled.path().string(), false);
            const StreamReport report = stream_layers(prepared.built.job, *backend, stream);
            display.finish();
            const std::string empty = empty_job_text(recipe, prepared.built.job, report);
            if (!empty.empty()) throw InputError(empty);
            for (const std::string& note : backend->notes()) say(options_, "note: " + note);
        }
        send_file(spooled.path(), "");
    }

    /// Sends a file, under a name from `stem` unless it has one.
    void send_file(const std::filesystem::path& path, const std::string& stem) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error))
            throw InputError(path.string() +
                             ": is no file; accepted: a recipe, a model, or a file to be printed");
        const auto source = make_file_source(path);
        source->count(&cancel_);
        if (options_.sending.name.empty())
            options_.sending.name = upload_name(stem, source->facts()->sha256, path.extension().string());
        ProgressDisplay display(options_.quiet, "sending: ");
        options_.sending.on_sent = [&](std::uint64_t bytes) {
            display.show(
                std::min(1.0, static_cast<double>(bytes) / static_cast<double>(source->facts()->size)));
        };
        finish(*source, display);
    }

    void finish(UploadSource& source, ProgressDisplay& display) {
        const SendReport report = send_upload(*host_, source, options_.sending);
        display.finish();
        const std::string& name = options_.sending.name;
        if (options_.json) {
            const nlohmann::ordered_json summary{
                {"host", known_.access.name}, {"kind", known_.kind->name},   {"name", name},
                {"bytes", report.size},       {"uploaded", report.uploaded}, {"attempts", report.attempts},
                {"started", report.started},  {"prints", report.prints},     {"seconds", display.seconds()}};
            TextOutput out("");
            out.write(summary.dump(2) + "\n");
            out.close();
        }
        if (report.uploaded)
            say(options_,
                fmt::format("{}: {} bytes in {:.1f} s, there whole", name, report.size, display.seconds()));
        if (report.started) say(options_, fmt::format("{}: prints", name));
        if (report.prints) say(options_, fmt::format("to watch it: lamella watch {}", options_.host));
    }

    SendOptions& options_;
    CancelToken cancel_;
    InterruptGuard guard_;
    KnownHost known_;
    std::unique_ptr<NetworkHost> host_;
};

}  // namespace

void add_send_command(CLI::App& root) {
    auto options = std::make_shared<SendOptions>();
    CLI::App& command =
        *root.add_subcommand("send", "Send layers or a ready file to a printer on the network");
    options->recipe.add_to(command);
    command.get_option("INPUT")->description(
        "Recipe (.toml), model (.stl, .obj, .ply, .3mf) or ready file (.gcode, .sl1, .goo, ...)");
    command
        .add_option("--host", options->host,
                    "Name in hosts.toml, or KIND+URL, such as moonraker+http://voron.local")
        ->type_name("HOST")
        ->required()
        ->group("Host");
    command.add_flag("--start", options->sending.start, "Print the file once the host has all of it")
        ->group("Host");
    command
        .add_option("--as", options->sending.name,
                    "Name of the file at the host; default: the part's name with a hash of its content")
        ->type_name("NAME")
        ->group("Host");
    command
        .add_flag("--no-spool", options->no_spool,
                  "Where the host asks for size or hash first: compute G-code twice, and write no file")
        ->group("Host");
    command.add_flag("--again", options->sending.again, "Upload even if the host has the file")
        ->group("Host");
    command.add_option("--attempts", options->sending.retry.attempts, "Tries of what fails; default: 5")
        ->check(CLI::Range(1, 100))
        ->group("Host");
    command
        .add_option("--retry-wait", options->sending.retry.first_wait,
                    "Seconds before the second try, doubled for each further one; default: 1")
        ->check(CLI::Range(0.0, 600.0))
        ->group("Host");
    command
        .add_option("--confirm", options->sending.retry.confirm,
                    "Seconds within which the host has to show a print that was started; default: 20")
        ->check(CLI::Range(0.0, 600.0))
        ->group("Host");
    add_job_options(command, *options);
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    command.add_flag("--json", options->json, "Write a summary of the run as JSON to standard output");
    finish_command(
        command,
        "  lamella send insole.toml --host voron --start\n"
        "  lamella send ready.gcode --host octoprint+http://octopi.local\n"
        "  lamella send insole.toml --host mk4 --no-spool\n"
        "Keys stand in ~/.config/lamella/hosts.toml (chmod 600) or in LAMELLA_HOST_KEY; `lamella hosts`\n"
        "shows what is known. Moonraker takes G-code while it is computed. Other hosts ask for its size\n"
        "first: it is written to a temporary file, or computed twice. What breaks is tried again; a\n"
        "print is started once, when the host has the file whole.");
    command.callback([options] { Send(*options).run(); });
}

}  // namespace lamella
