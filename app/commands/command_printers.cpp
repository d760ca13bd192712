// `lamella printers`: lists back-ends and machine profiles, or prints one profile as TOML.
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "engine/base/error.h"
#include "recipe/printer_choice.h"
#include "recipe/read_recipe.h"

namespace lamella {

namespace {

struct PrintersOptions {
    std::string name;
    std::string folder;
};

void run(const PrintersOptions& options) {
    const MachineProfiles profiles = machine_profiles(options.folder);
    std::string text;
    if (options.name.empty()) {
        text = printers_listing(profiles);
    } else {
        const auto profile = profiles.find(options.name);
        if (!profile) throw InputError("printer " + profiles.unknown(options.name));
        text = profile_as_toml(*profile);
    }
    TextOutput out("");
    out.write(text);
    out.close();
}

}  // namespace

void add_printers_command(CLI::App& root) {
    auto options = std::make_shared<PrintersOptions>();
    CLI::App& command = *root.add_subcommand("printers", "List back-ends and machine profiles");
    command
        .add_option("NAME", options->name,
                    "Write this profile as TOML, with all its values; default: list all profiles")
        ->type_name("");
    add_profile_folder_option(command, options->folder);
    finish_command(command,
                   "  lamella printers\n"
                   "  lamella printers prusa-sl1s > ~/.config/lamella/printers/my-sl1s.toml");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
