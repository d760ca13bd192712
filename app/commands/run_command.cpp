// Parses the command line and runs its subcommand.
#include "app/commands/run_command.h"

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/error_report.h"
#include "app/console/text_output.h"
#include "app/help/command_help.h"

namespace lamella {

namespace {

constexpr int bad_input = 2;

/// Returns the deepest subcommand named, whose help is printed.
CLI::App& chosen(CLI::App& root) {
    const auto named = root.get_subcommands();
    return named.empty() ? root : chosen(*named.front());
}

int print(const std::string& text) {
    TextOutput output("");
    output.write(text);
    output.close();
    return 0;
}

int parse_and_run(CLI::App& root, const std::vector<std::string>& arguments) {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend() - 1);
    try {
        root.parse(reversed);
        return 0;
    } catch (const CLI::CallForHelp&) {
        return print(help_text(chosen(root), HelpExtent::common));
    } catch (const CLI::CallForAllHelp&) {
        return print(help_text(chosen(root), HelpExtent::all));
    } catch (const CLI::CallForVersion&) {
        return print("lamella " LAMELLA_VERSION "\n");
    } catch (const CLI::ParseError& error) {
        const CLI::App& command = chosen(root);
        const std::string name = &command == &root ? "lamella" : "lamella " + command.get_name();
        return report_error(std::string(error.what()) + "; `" + name + " --help` shows what is accepted",
                            bad_input);
    }
}

}  // namespace

int run_command(const std::vector<std::string>& arguments) {
    try {
        CLI::App root(
            "Streaming procedural layers for 3D printing: turns meshes, shapes and foam into printable "
            "layers.",
            "lamella");
        root.require_subcommand(1);
        root.set_help_all_flag("--help-all", "Print the help with all options, and exit");
        finish_command(
            root,
            "  lamella slice insole.toml -o insole/\n"
            "  lamella slice model.stl --cell 3 --beam 0.5 --skin 0.8 --printer png -o out/\n"
            "  lamella slice --help      the options of one command; --help-all: with all keys of a recipe\n"
            "  lamella keys foam         the keys of one section of a recipe; lamella keys: of all\n" +
                exit_codes_line());
        add_slice_command(root, arguments);
        add_join_command(root, arguments);
        add_print_command(root, arguments);
        add_ports_command(root);
        add_send_command(root);
        add_watch_command(root);
        add_hosts_command(root);
        add_preview_command(root);
        add_info_command(root);
        add_extract_command(root);
        add_section_command(root);
        add_dump_command(root);
        add_orient_command(root);
        add_supports_command(root);
        add_check_command(root);
        add_serve_command(root);
        add_studio_command(root);
        add_homogenize_command(root);
        add_optimize_command(root);
        add_analyze_command(root);
        add_pattern_command(root);
        add_printers_command(root);
        add_materials_command(root);
        add_keys_command(root);
        add_completion_command(root);
        add_man_command(root);
        return parse_and_run(root, arguments);
    } catch (...) {
        return report_exception();
    }
}

}  // namespace lamella
