// Help as the command line prints it: the options that most jobs need, or all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lamella {

enum class HelpExtent : unsigned char {
    common,  ///< options of the command itself, two dozen recipe options, and the names of the groups of the
             ///< others
    all,
};

/// Returns the help of a command. Changes groups and descriptions of its options, so the command can only
/// print its help and end.
std::string help_text(CLI::App& command, HelpExtent extent);

}  // namespace lamella
