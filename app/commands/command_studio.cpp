// `lamella studio`: a page in the browser that shows the part while it is changed.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/commands/server_options.h"
#include "app/console/interrupt.h"
#include "app/server/embedded_files.h"
#include "app/server/server_state.h"

namespace lamella {

namespace {

struct StudioCommand {
    ServerFlags server;
    std::string recipe;
};

void run(const StudioCommand& command) {
    if (page_files().empty()) {
        throw InputError(
            "this program was built without the studio's page; accepted: a build with npm, or `lamella serve "
            "--http`");
    }
    ServerOptions options = server_options(command.server);
    options.has_page = true;
    if (!command.recipe.empty()) {
        const std::filesystem::path path(command.recipe);
        if (path.extension() != ".toml" || !std::filesystem::is_regular_file(path))
            throw InputError(command.recipe + ": no recipe; accepted: a .toml file, or none to begin anew");
        if (command.server.folder.empty()) options.folder = path.has_parent_path() ? path.parent_path() : ".";
        // Paths in a recipe are relative to its folder, and so are those of the server.
        std::error_code error;
        const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : ".";
        if (!std::filesystem::equivalent(parent, options.folder, error))
            throw InputError("--folder: " + command.recipe +
                             " does not lie in it; accepted: the recipe's folder");
        options.recipe = path.filename().string();
    }
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    serve_http(options, cancel, [](const std::string& address) {
        std::fputs(("the studio is at " + address + "\nCtrl-C ends it\n").c_str(), stdout);
        std::fflush(stdout);
    });
}

}  // namespace

void add_studio_command(CLI::App& root) {
    auto options = std::make_shared<StudioCommand>();
    CLI::App& command =
        *root.add_subcommand("studio", "Show the part in the browser while you change its recipe");
    command.add_option("recipe", options->recipe, "Recipe to begin with (.toml)")->type_name("RECIPE");
    add_server_options(command, options->server);
    finish_command(
        command,
        "  lamella studio part.toml\n"
        "  lamella studio --folder models --port 8080\n"
        "The page is for this machine alone; its address holds a token. To reach it from another one, "
        "tunnel\n"
        "the port: ssh -L 8080:localhost:8080 pi. Files outside the folder are neither read nor "
        "written.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
