// `lamella printers`: the back-ends and the machine profiles.
#include "app/commands.h"
#include "app/printer_choice.h"
#include "app/recipe_options.h"
#include "app/text_output.h"

namespace lamella {

void add_printers_command(CLI::App& root) {
    CLI::App& command = *root.add_subcommand("printers", "List back-ends and machine profiles");
    finish_command(command, "  lamella printers");
    command.callback([] {
        TextOutput out("");
        out.write(printers_listing());
        out.close();
    });
}

}  // namespace lamella
