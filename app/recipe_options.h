// RecipeOptions: the command-line options that the settings table makes, and the recipe they lead to.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/machine_profiles.h"
#include "app/recipe.h"

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

/// The recipe of a file, or of a model without foam and skin. Throws InputError with all mistakes at once.
Recipe read_recipe(const std::string& input, const MachineProfiles& profiles);

/// Adds --printers to a subcommand.
void add_profile_folder_option(CLI::App& command, std::string& folder);

/// The profiles that a run knows: those in `folder` (none when empty), then the user's, then the built-in
/// ones. Throws InputError when the folder does not exist.
MachineProfiles machine_profiles(const std::string& folder);

/// Says in a line on standard error which entries of the recipe nothing uses, if there are any.
void note_unused(const RecipeOptions& options, const Recipe& recipe);

/// Makes --version and the examples of a subcommand's help.
void finish_command(CLI::App& command, const std::string& examples);

}  // namespace lamella
