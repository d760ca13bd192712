// Help as the command line prints it: the options that most jobs need, or all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>

namespace lamella {

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
    common,  ///< options of the command itself, two dozen recipe options, and the groups of the others by
             ///< name
    all,
};

/// Returns the help of a command. Changes groups and descriptions of its options: for a command that prints
/// its help and ends.
std::string help_text(CLI::App& command, HelpExtent extent);

}  // namespace lamella
