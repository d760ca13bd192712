// RecipeOptions: the command-line options generated from the settings table, and the recipe that they
// describe.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "recipe/machine_profiles.h"
#include "recipe/recipe.h"

namespace lamella {

/// The input (a recipe or a model) and one option for each setting. Must outlive the parsing of the command
/// line.
class RecipeOptions {
  public:
    /// Adds the options to a subcommand, a group for each section.
    void add_to(CLI::App& command);

    /// Returns the recipe: flags have precedence over the recipe file. Throws InputError with all mistakes at
    /// once. Without `needs_body` the part may be missing.
    Recipe read(bool needs_body = true) const;

    /// Returns the machines that the recipe can name.
    MachineProfiles profiles() const;

    /// Returns the text given with a flag of the settings table, such as --host; empty when there is none.
    std::string given(const std::string& flag) const;

    /// Returns the input as given; empty when there is none.
    const std::string& input() const { return input_; }

  private:
    std::string input_;
    std::string profile_folder_;
    std::vector<std::string> texts_;     ///< by row of the table
    std::vector<CLI::Option*> options_;  ///< by row of the table; null for rows without a flag
};

/// Adds --printers to a subcommand.
void add_profile_folder_option(CLI::App& command, std::string& folder);

/// Prints a line on standard error that lists the recipe's unused entries, if there are any.
void note_unused(const RecipeOptions& options, const Recipe& recipe);

/// Adds --version and examples to the help of a subcommand.
void finish_command(CLI::App& command, const std::string& examples);

}  // namespace lamella
