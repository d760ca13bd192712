// `lamella watch`: the print of a printer on the network, until it ends.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/interrupt.h"
#include "app/console/text_output.h"
#include "engine/base/error.h"
#include "hosts/known_hosts.h"
#include "hosts/print_end.h"
#include "hosts/watch_print.h"

namespace lamella {

namespace {

struct WatchOptions {
    std::string host;
    WatchSettings watching;
    std::vector<std::string> then;
    bool once = false, json = false;
    bool pause = false, resume = false, cancel = false;
};

/// Writes each status that differs from the last as a line.
class StatusLines {
  public:
    explicit StatusLines(bool json) : json_(json) {}

    void show(const HostStatus& status) {
        const std::string line =
            json_ ? status_json(status).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                  : status_text(status);
        if (line == last_) return;
        last_ = line;
        out_.write(line + "\n");
        out_.flush();
    }

  private:
    bool json_;
    TextOutput out_{""};
    std::string last_;
};

void run(WatchOptions& options) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const KnownHost known = find_host(options.host);
    const auto host = known.connect(&cancel);
    StatusLines lines(options.json);
    if (options.pause || options.resume || options.cancel) {
        if (options.pause) host->pause();
        if (options.resume) host->resume();
        if (options.cancel) host->cancel();
        lines.show(host->status());
        return;
    }
    if (options.once) {
        lines.show(host->status());
        return;
    }
    bool began = false;
    options.watching.cancel = &cancel;
    options.watching.on_status = [&](const HostStatus& status) {
        began = began || is_active(status.state);
        lines.show(status);
    };
    options.watching.on_trouble = [](const std::string& text) {
        std::fputs((text + "; asking again\n").c_str(), stderr);
    };
    const HostStatus last = watch_print(*host, options.watching);
    if (!began) return;
    const EndNotice notice{options.then.empty() ? known.done : options.then, known.webhook};
    tell_end(notice, known.access.name, last);
    if (last.state != PrintState::finished)
        throw FaultError(
            fmt::format("{}: the print has not ended well: {}", known.access.name, status_text(last)));
}

}  // namespace

void add_watch_command(CLI::App& root) {
    auto options = std::make_shared<WatchOptions>();
    CLI::App& command =
        *root.add_subcommand("watch", "Watch, pause, resume or cancel a print on the network");
    command
        .add_option("HOST", options->host,
                    "Name in hosts.toml, or KIND+URL, such as moonraker+http://voron.local")
        ->required();
    CLI::Option* pause = command.add_flag("--pause", options->pause, "Pause the print, and return");
    CLI::Option* resume = command.add_flag("--resume", options->resume, "Go on after a pause, and return");
    CLI::Option* cancel = command.add_flag("--cancel", options->cancel, "Cancel the print, and return");
    pause->excludes(resume)->excludes(cancel);
    resume->excludes(cancel);
    command.add_flag("--once", options->once, "Show the status once, and return");
    command.add_flag("--json", options->json, "A line of JSON for each change");
    command.add_option("--interval", options->watching.interval, "Seconds between two questions; default: 2")
        ->check(CLI::Range(0.05, 3600.0));
    command
        .add_option("--patience", options->watching.patience,
                    "Seconds without an answer after which the host is given up; default: 60")
        ->check(CLI::Range(0.0, 86400.0));
    command.add_option(
        "PROGRAM", options->then,
        "After --: a program and its arguments, run when the print has ended, without a shell; "
        "default: `done` in hosts.toml");
    finish_command(
        command,
        "  lamella watch voron\n"
        "  lamella watch voron --json --interval 10\n"
        "  lamella watch voron --pause\n"
        "  lamella watch voron -- notify-send \"The print has ended\"\n"
        "The program finds LAMELLA_HOST, LAMELLA_FILE and LAMELLA_STATE in its environment. Exit codes: 0\n"
        "the print has ended well, or there was none; 3 it has not, or the host does not answer.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
