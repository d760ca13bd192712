// Help as the command line prints it: the options that most jobs need, or all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <string_view>

namespace lamella {

/// What the groups of options begin with that are made from the settings table: "Recipe [foam]".
inline constexpr std::string_view recipe_group = "Recipe [";

/// What the program's exit code tells.
struct ExitCode {
    int code;
    const char* meaning;
};
inline constexpr std::array exit_codes{
    ExitCode{0, "done"},          ExitCode{1, "a constraint is violated"},
    ExitCode{2, "bad input"},     ExitCode{3, "a fault while running"},
    ExitCode{130, "interrupted"},
};

/// "Exit codes: 0 done, 1 a constraint is violated, ...": a line of the help.
std::string exit_codes_line();

enum class HelpExtent : unsigned char {
    common,  ///< options of the command itself, two dozen recipe options, and the names of the groups of the
             ///< others
    all,
};

/// Returns the help of a command. Changes groups and descriptions of its options, so the command can only
/// print its help and end.
std::string help_text(CLI::App& command, HelpExtent extent);

}  // namespace lamella
