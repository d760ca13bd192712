// `lamella keys`: the reference of everything a recipe can say.
#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "recipe/settings.h"

namespace lamella {

void add_keys_command(CLI::App& root) {
    CLI::App& command =
        *root.add_subcommand("keys", "List every key of a recipe, with its flag, range and default");
    finish_command(command, "  lamella keys");
    command.callback([] {
        TextOutput out("");
        out.write(settings_reference());
        out.close();
    });
}

}  // namespace lamella
