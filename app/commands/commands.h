// The subcommands of `lamella`: each function adds one to the command line, and its callback runs it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lamella {

/// `arguments` is the command line as typed, for the command to resume after an interruption.
void add_slice_command(CLI::App& root, const std::vector<std::string>& arguments);
/// `arguments` as in add_slice_command.
void add_join_command(CLI::App& root, const std::vector<std::string>& arguments);
/// `arguments` as in add_slice_command.
void add_print_command(CLI::App& root, const std::vector<std::string>& arguments);
void add_ports_command(CLI::App& root);
void add_send_command(CLI::App& root);
void add_watch_command(CLI::App& root);
void add_hosts_command(CLI::App& root);
void add_preview_command(CLI::App& root);
void add_info_command(CLI::App& root);
void add_extract_command(CLI::App& root);
void add_dump_command(CLI::App& root);
void add_supports_command(CLI::App& root);
void add_orient_command(CLI::App& root);
void add_check_command(CLI::App& root);
void add_section_command(CLI::App& root);
void add_serve_command(CLI::App& root);
void add_studio_command(CLI::App& root);
void add_homogenize_command(CLI::App& root);
void add_optimize_command(CLI::App& root);
void add_analyze_command(CLI::App& root);
void add_pattern_command(CLI::App& root);
void add_printers_command(CLI::App& root);
void add_materials_command(CLI::App& root);
void add_keys_command(CLI::App& root);
void add_completion_command(CLI::App& root);
void add_man_command(CLI::App& root);

}  // namespace lamella
