// Manual pages, in roff: lamella(1), and one page a command.
#pragma once

#include <string>

#include "app/help/command_reference.h"

namespace lamella {

/// "lamella" for the program itself, "lamella-slice" for a command: the page's name without its section, 1.
std::string man_page_name(const CommandReference& command);

/// Returns the page of the program: what it is for, its commands, exit codes and files. It has no date, so
/// that the same program makes the same page.
std::string program_man_page(const ProgramReference& reference);

/// Returns the page of a command, with all its options, in the groups of --help-all.
std::string command_man_page(const CommandReference& command);

}  // namespace lamella
