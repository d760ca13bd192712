// Help as the command line prints it: the options that most jobs need, or all of them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lamella {

enum class HelpExtent : unsigned char {
    common,  ///< options of the command itself, two dozen recipe options, and the groups of the others by
             ///< name
    all,
};

/// Returns the help of a command. Changes groups and descriptions of its options: for a command that prints
/// its help and ends.
std::string help_text(CLI::App& command, HelpExtent extent);

}  // namespace lamella
