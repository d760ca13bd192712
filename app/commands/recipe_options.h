// RecipeOptions: the command-line options that the settings table makes, and the recipe they lead to.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "recipe/machine_profiles.h"
#include "recipe/recipe.h"

namespace lamella {

/// The input (a recipe or a model) and one option for each setting. Lives as long as the command line is
/// parsed.
class RecipeOptions {
  public:
    /// Adds the options to a subcommand, in one group for each section.
    void add_to(CLI::App& command);

    /// Recipe file first, flags over it. Throws InputError with all mistakes at once. Without `needs_body`
    /// the part may be missing.
    Recipe read(bool needs_body = true) const;

    /// The machines that the recipe can name.
    MachineProfiles profiles() const;

    /// The input as given; empty when there is none.
    const std::string& input() const { return input_; }

  private:
    std::string input_;
    std::string profile_folder_;
    std::vector<std::string> texts_;     ///< by row of the table
    std::vector<CLI::Option*> options_;  ///< by row of the table; null for rows without a flag
};

/// Adds --printers to a subcommand.
void add_profile_folder_option(CLI::App& command, std::string& folder);

/// Says in a line on standard error which entries of the recipe nothing uses, if there are any.
void note_unused(const RecipeOptions& options, const Recipe& recipe);

/// Makes --version and the examples of a subcommand's help.
void finish_command(CLI::App& command, const std::string& examples);

}  // namespace lamella
