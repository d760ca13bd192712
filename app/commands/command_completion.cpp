// `lamella completion`: scripts that complete the command line in a shell.
#include <memory>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "app/help/completion_scripts.h"

namespace lamella {

void add_completion_command(CLI::App& root) {
    CLI::App& command = *root.add_subcommand(
        "completion", "Print the script that completes commands, options and their words in a shell");
    const auto shell = std::make_shared<std::string>();
    command.add_option("SHELL", *shell, "Shell that the script is for")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}))
        ->type_name("");
    finish_command(command,
                   "  source <(lamella completion bash)     # in ~/.bashrc\n"
                   "  source <(lamella completion zsh)      # in ~/.zshrc, below compinit\n"
                   "  lamella completion fish | source      # in ~/.config/fish/config.fish\n"
                   "An installed program has all scripts where the shells look for them.");
    command.callback([&root, shell] {
        const ProgramReference reference = read_reference(root);
        TextOutput out("");
        out.write(*shell == "bash"  ? bash_completion(reference)
                  : *shell == "zsh" ? zsh_completion(reference)
                                    : fish_completion(reference));
        out.close();
    });
}

}  // namespace lamella
