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
#include "app/jobs/send_job.h"
#include "engine/base/error.h"
#include "hosts/known_hosts.h"
#include "hosts/transfer/upload_source.h"

namespace lamella {

namespace {

struct SendOptions : JobOptions {
    JobSending sending;
    bool json = false;
};

bool is_recipe_or_model(const std::string& input) {
    const auto endings = {".toml", ".stl", ".obj", ".ply", ".3mf"};
    return input.empty() ||
           std::ranges::any_of(endings, [&](const char* ending) { return input.ends_with(ending); });
}

void say(const SendOptions& options, const std::string& text) {
    if (!options.quiet) std::fputs((text + "\n").c_str(), stderr);
}

/// One run of the command.
class Send {
  public:
    explicit Send(SendOptions& options)
        : options_(options), upload_(options.sending.upload), guard_(cancel_) {
        upload_.cancel = &cancel_;
        upload_.on_note = [this](const std::string& text) { say(options_, text); };
    }

    void run() {
        const std::string& input = options_.recipe.input();
        if (!is_recipe_or_model(input)) return send_file(input);
        const Recipe recipe = options_.recipe.read();
        connect(recipe.printer.host);
        const PreparedJob prepared = prepare_job(options_, recipe, cancel_);
        ProgressDisplay computing(options_.quiet), sending(options_.quiet, "sending: ");
        options_.sending.stream = prepared.stream;
        options_.sending.stream.on_progress = [&](const Progress& progress) { computing.show(progress); };
        show_bytes(sending);
        const JobSendReport report = send_job(*host_, recipe, prepared.built.job, options_.sending);
        computing.finish();
        sending.finish();
        sum_up(report, sending.seconds());
    }

  private:
    void connect(const std::string& host) {
        if (host.empty())
            throw InputError(
                "--host: missing; accepted: a name in hosts.toml, or an address with its kind, such as "
                "moonraker+http://voron.local; `lamella hosts` lists both");
        known_ = find_host(host);
        host_ = known_.connect(&cancel_);
        if (host_->is_plain()) say(options_, known_.access.name + ": nothing is encrypted on the way there");
        greet_host(*host_, upload_);
    }

    /// Shows the bytes of uploads whose size is known; others are shown by their layers.
    void show_bytes(ProgressDisplay& display) {
        upload_.on_sent = [&](std::uint64_t bytes, std::optional<std::uint64_t> of) {
            if (of) display.show(std::min(1.0, static_cast<double>(bytes) / static_cast<double>(*of)));
        };
    }

    void send_file(const std::filesystem::path& path) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error))
            throw InputError(path.string() +
                             ": is no file; accepted: a recipe, a model, or a file to be printed");
        connect(options_.recipe.given("--host"));
        const auto source = make_file_source(path);
        source->count(&cancel_);
        if (upload_.name.empty())
            upload_.name =
                upload_name(path.stem().string(), source->facts()->sha256, path.extension().string());
        ProgressDisplay display(options_.quiet, "sending: ");
        show_bytes(display);
        const SendReport report = send_upload(*host_, *source, upload_);
        display.finish();
        sum_up({upload_.name, report}, display.seconds());
    }

    void sum_up(const JobSendReport& report, double seconds) const {
        const SendReport& upload = report.upload;
        if (options_.json) {
            const nlohmann::ordered_json summary{
                {"host", known_.access.name}, {"kind", known_.kind->name},   {"name", report.name},
                {"bytes", upload.size},       {"uploaded", upload.uploaded}, {"attempts", upload.attempts},
                {"started", upload.started},  {"prints", upload.prints},     {"seconds", seconds}};
            TextOutput out("");
            out.write(summary.dump(2) + "\n");
            out.close();
        }
        if (upload.uploaded)
            say(options_,
                fmt::format("{}: {} bytes in {:.1f} s, there whole", report.name, upload.size, seconds));
        if (upload.started) say(options_, report.name + ": prints");
        if (upload.prints) say(options_, "to watch it: lamella watch " + known_.named);
    }

    SendOptions& options_;
    SendSettings& upload_;
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
    command.add_flag("--start", options->sending.upload.start, "Print the file once the host has all of it")
        ->group("Host");
    command
        .add_option("--as", options->sending.upload.name,
                    "Name of the file at the host; default: the part's name with a hash of its content")
        ->type_name("NAME")
        ->group("Host");
    command
        .add_flag("--no-spool", options->sending.no_spool,
                  "Where the host asks for size or hash first: compute G-code twice, and write no file")
        ->group("Host");
    command.add_flag("--again", options->sending.upload.again, "Upload even if the host has the file")
        ->group("Host");
    command
        .add_option("--attempts", options->sending.upload.retry.attempts, "Tries of what fails; default: 5")
        ->check(CLI::Range(1, 100))
        ->group("Host");
    command
        .add_option("--retry-wait", options->sending.upload.retry.first_wait,
                    "Seconds before the second try, doubled for each further one; default: 1")
        ->check(CLI::Range(0.0, 600.0))
        ->group("Host");
    command
        .add_option("--confirm", options->sending.upload.retry.confirm,
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
