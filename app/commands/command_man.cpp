// `lamella man`: manual pages of the program and its commands.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "app/help/man_page.h"
#include "engine/base/error.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

struct ManOptions {
    std::string command;
    std::string output;
};

void write_page(const std::string& path, const std::string& text) {
    TextOutput out(path);
    out.write(text);
    out.close();
}

void write_all_pages(const std::string& folder, const ProgramReference& reference) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) throw FaultError(folder + ": cannot be made: " + failed.message());
    const auto path = [&](const CommandReference& command) {
        return folder + "/" + man_page_name(command) + ".1";
    };
    write_page(path(reference.program), program_man_page(reference));
    for (const CommandReference& command : reference.commands)
        write_page(path(command), command_man_page(command));
}

void run(const ManOptions& options, const ProgramReference& reference) {
    if (!options.output.empty()) {
        if (!options.command.empty())
            throw InputError("--output: takes the pages of all commands; accepted: no COMMAND with it");
        return write_all_pages(options.output, reference);
    }
    if (options.command.empty()) return write_page("", program_man_page(reference));
    const auto found = std::ranges::find(reference.commands, options.command, &CommandReference::name);
    if (found == reference.commands.end()) {
        const std::string near = nearest(options.command, command_names(reference));
        throw InputError("COMMAND: there is no `lamella " + options.command.substr(0, 64) + "`" +
                         (near.empty() ? "; `lamella --help` lists all" : ", did you mean `" + near + "`?"));
    }
    write_page("", command_man_page(*found));
}

}  // namespace

void add_man_command(CLI::App& root) {
    CLI::App& command = *root.add_subcommand("man", "Print a manual page, for the program `man` (roff)");
    const auto options = std::make_shared<ManOptions>();
    command.add_option("COMMAND", options->command, "Command that the page is about; default: all in short")
        ->type_name("");
    command.add_option("-o,--output", options->output, "Folder to put the pages of all commands into")
        ->type_name("DIR");
    finish_command(command,
                   "  lamella man slice | man -l -\n"
                   "  lamella man -o man1/\n"
                   "An installed program has all pages: `man lamella-slice`.");
    command.callback([&root, options] { run(*options, read_reference(root)); });
}

}  // namespace lamella
