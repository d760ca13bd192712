// Completion scripts of shells: they hold all words themselves, and do not run the command when TAB is
// pressed.
#pragma once

#include <string>

#include "app/help/command_reference.h"

namespace lamella {

/// Returns the script for bash, 3.2 or later; it needs no other script.
std::string bash_completion(const ProgramReference& reference);

/// Returns the script for zsh: a file `_lamella` on its fpath, or to be sourced after compinit.
std::string zsh_completion(const ProgramReference& reference);

/// Returns the script for fish, 3.5 or later. All places of a command offer what any of them takes.
std::string fish_completion(const ProgramReference& reference);

}  // namespace lamella
