// What the help of all commands says, as plain data: completion scripts and manual pages are written from it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lamella {

/// What an option takes, or what stands at a place of the command line.
enum class ValueKind : unsigned char {
    none,     ///< of a flag
    free,     ///< a number, a text or a formula: nothing to complete
    words,    ///< one of those listed
    file,     ///< with one of the endings listed; with any ending where none is listed
    folder,   ///< one that exists or is to be made
    output,   ///< a file or folder to make, with "@" and a machine profile behind it or not
    machine,  ///< name of a machine profile or back-end, or a profile's file
    port      ///< a serial port
};

struct ValueReference {
    ValueKind kind = ValueKind::none;
    std::string hint;                  ///< "MM|FORMULA"; empty for places of the command line
    std::string accepted;              ///< "0 to 4096"; empty where the help of the option says it
    std::vector<std::string> words;    ///< by ValueKind::words
    std::vector<std::string> endings;  ///< by ValueKind::file, with their dots, in lower case
    bool takes_several = false;        ///< all words up to the next option

    bool operator==(const ValueReference&) const = default;
};

/// An option (names with their dashes), or a place of the command line (one name without).
struct OptionReference {
    std::vector<std::string> names;
    std::string group;
    std::string help;
    ValueReference value;
    bool required = false;
    bool repeats = false;
};

struct CommandReference {
    std::string name;  ///< empty for the program itself
    std::string help;
    std::vector<OptionReference> options;  ///< in the order of --help-all
    std::vector<OptionReference> places;
    std::vector<std::string> examples;  ///< command lines
    std::string notes;                  ///< what is said below the examples; may be empty
};

struct ProgramReference {
    CommandReference program;
    std::vector<CommandReference> commands;
    std::vector<std::string> machines;  ///< profiles and back-ends that are built in
};

/// Returns the reference of the whole command line. `root` must be as it was made: help_text() changes groups
/// and descriptions.
ProgramReference read_reference(const CLI::App& root);

/// Whether an option stands for a key of the recipe; the same options stand in every command with a recipe.
bool is_recipe_option(const OptionReference& option);

/// Returns the names of a command's options, those of recipe keys or the others.
std::vector<std::string> option_names(const CommandReference& command, bool of_recipe);

/// Returns all commands' names.
std::vector<std::string> command_names(const ProgramReference& reference);

}  // namespace lamella
