// `lamella keys`: prints the reference of all recipe keys.
#include <memory>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "recipe/settings.h"

namespace lamella {

void add_keys_command(CLI::App& root) {
    struct Options {
        std::string section;
        bool markdown = false;
    };
    CLI::App& command =
        *root.add_subcommand("keys", "List the keys of a recipe, with flag, range and default");
    const auto options = std::make_shared<Options>();
    command.add_option("SECTION", options->section, "One section of the recipe, such as foam")->type_name("");
    command.add_flag("--markdown", options->markdown, "Write a Markdown page");
    finish_command(command,
                   "  lamella keys\n"
                   "  lamella keys foam");
    command.callback([options] {
        TextOutput out("");
        out.write(options->markdown ? settings_markdown() : settings_reference(options->section));
        out.close();
    });
}

}  // namespace lamella
