// Manual pages from the reference of the command line.
#include "app/help/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/help/command_help.h"
#include "app/help/roff.h"

namespace lamella {
namespace {

struct FilePlace {
    const char* path;
    const char* meaning;
};

constexpr std::array file_places{
    FilePlace{"~/.config/lamella/hosts.toml",
              "Printers on the network, with their keys; below $XDG_CONFIG_HOME where that is set."},
    FilePlace{"~/.config/lamella/printers/*.toml",
              "The user's machine profiles; below $XDG_CONFIG_HOME where that is set."},
    FilePlace{
        "~/.cache/lamella/plans/",
        "Plans of supports, kept for later runs of the same job; below $XDG_CACHE_HOME where that is set."},
};

std::string heading(const CommandReference& command) {
    std::string title = man_page_name(command);
    for (char& c : title) c = 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return fmt::format(".TH {} 1 \"\" \"lamella " LAMELLA_VERSION "\" \"Lamella\"\n.SH NAME\n{} \\- {}\n",
                       roff_literal(title), roff_literal(man_page_name(command)), roff_prose(command.help));
}

std::string bold(std::string_view text) { return "\\fB" + roff_literal(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff_literal(text) + "\\fR"; }

/// "-o, --output FILE" and below it the help.
std::string man_entry(const OptionReference& option) {
    std::string names;
    for (const std::string& name : option.names) {
        if (!names.empty()) names += ", ";
        names += name.starts_with('-') ? bold(name) : italic(name);
    }
    if (!option.value.hint.empty()) names += " " + italic(option.value.hint);
    if (option.value.takes_several) names += " ...";
    std::string text = roff_prose(option.help);
    // The help of a recipe key has the words that it accepts.
    std::string accepted = option.value.accepted;
    if (option.value.kind == ValueKind::words && !is_recipe_option(option)) {
        for (const std::string& word : option.value.words) accepted += (accepted.empty() ? "" : ", ") + word;
    }
    if (!text.ends_with('.')) text += '.';
    if (!accepted.empty()) text += " Accepts " + roff_literal(accepted) + ".";
    if (option.required) text += " Required.";
    return fmt::format(".TP\n{}\n{}\n", names, text);
}

std::string synopsis(const CommandReference& command) {
    std::string text = ".SH SYNOPSIS\n" + bold("lamella " + command.name) + " [" + italic("OPTIONS") + "]";
    for (const OptionReference& place : command.places) {
        const std::string name = italic(place.names.front());
        text += place.required ? " " + name : " [" + name + "]";
    }
    return text + "\n";
}

/// All options, those of a group under its name.
std::string option_sections(const CommandReference& command) {
    std::string text = ".SH OPTIONS\n", group = "Options";
    for (const OptionReference& option : command.options) {
        if (option.group == group) text += man_entry(option);
    }
    std::vector<std::string> done{group};
    for (const OptionReference& first : command.options) {
        if (first.group.empty() || std::ranges::find(done, first.group) != done.end()) continue;
        done.push_back(first.group);
        text += ".SS " + roff_prose(first.group) + "\n";
        for (const OptionReference& option : command.options) {
            if (option.group == first.group) text += man_entry(option);
        }
    }
    return text;
}

std::string example_section(const CommandReference& command) {
    if (command.examples.empty()) return "";
    std::string text = ".SH EXAMPLES\n.nf\n";
    for (const std::string& line : command.examples) text += roff_literal(line) + "\n";
    return text + ".fi\n";
}

bool has_recipe(const CommandReference& command) {
    return std::ranges::any_of(command.options, is_recipe_option);
}

}  // namespace

std::string man_page_name(const CommandReference& command) {
    return command.name.empty() ? "lamella" : "lamella-" + command.name;
}

std::string program_man_page(const ProgramReference& reference) {
    const CommandReference& program = reference.program;
    std::string text = heading(program);
    text += fmt::format(".SH SYNOPSIS\n{} [{}]\n.br\n{} {} [{}]\n", bold("lamella"), italic("OPTIONS"),
                        bold("lamella"), italic("COMMAND"), italic("OPTIONS"));
    text += ".SH DESCRIPTION\n" + roff_prose(program.help) + "\n.PP\n";
    text += roff_prose(
                "A job is a recipe (a TOML file), a model with options, or both; options win. Lengths are "
                "millimetres, angles degrees, moduli megapascals and temperatures degrees Celsius.") +
            "\n.SH COMMANDS\n";
    for (const CommandReference& command : reference.commands)
        text += fmt::format(".TP\n{}(1)\n{}.\n", bold(man_page_name(command)), roff_prose(command.help));
    text += option_sections(program) + example_section(program) + ".SH EXIT STATUS\n";
    for (const ExitCode& code : exit_codes) text += fmt::format(".TP\n{}\n{}.\n", code.code, code.meaning);
    text += ".SH FILES\n";
    for (const FilePlace& place : file_places)
        text += fmt::format(".TP\n{}\n{}\n", italic(place.path), roff_prose(place.meaning));
    text += ".SH SEE ALSO\n";
    for (const CommandReference& command : reference.commands) {
        text += bold(man_page_name(command)) + "(1)";
        text += &command == &reference.commands.back() ? "\n" : ",\n";
    }
    return text;
}

std::string command_man_page(const CommandReference& command) {
    std::string text = heading(command) + synopsis(command) + ".SH DESCRIPTION\n";
    text += roff_prose(command.help) + ".\n";
    for (const OptionReference& place : command.places) text += man_entry(place);
    text += option_sections(command) + example_section(command);
    if (!command.notes.empty()) text += ".SH NOTES\n" + roff_prose(command.notes) + "\n";
    text += ".SH SEE ALSO\n" + bold("lamella") + "(1)";
    if (has_recipe(command)) {
        for (const char* other : {"lamella-keys", "lamella-printers", "lamella-materials"})
            text += ",\n" + bold(other) + "(1)";
    }
    return text + "\n";
}

}  // namespace lamella
