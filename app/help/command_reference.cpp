// Reading the reference off the options of the command line, the settings table and the lists that ship.
#include "app/help/command_reference.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>

#include "app/help/command_help.h"
#include "recipe/base_material.h"
#include "recipe/machine_profiles.h"
#include "recipe/settings.h"

namespace lamella {
namespace {

constexpr std::string_view examples_heading = "Examples:\n";

/// The row of the settings table that an option stands for; null when it stands for none.
const Setting* setting_of(const OptionReference& option) {
    if (!is_recipe_option(option)) return nullptr;
    const auto has_flag = [&](const Setting& row) { return row.flag == option.names.front(); };
    const auto found = std::ranges::find_if(settings(), has_flag);
    return found == settings().end() ? nullptr : &*found;
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(separator, from), text.size());
        parts.emplace_back(text.substr(from, to - from));
        from = to + 1;
    }
    return parts;
}

/// The endings that a help names in parentheses: "Recipe (.toml) or model (.stl, .obj)".
std::vector<std::string> endings_in(std::string_view help) {
    std::vector<std::string> endings;
    bool inside = false;
    for (std::size_t i = 0; i < help.size(); ++i) {
        if (help[i] == '(') inside = true;
        if (help[i] == ')') inside = false;
        if (!inside || help[i] != '.' || (help[i - 1] != '(' && help[i - 1] != ' ')) continue;
        std::size_t end = i + 1;
        const auto belongs = [&](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '.'; };
        while (end < help.size() && belongs(help[end])) ++end;
        if (end > i + 1) endings.emplace_back(help.substr(i, end - i));
        i = end - 1;
    }
    return endings;
}

/// Takes apart what CLI11 says of a value: "WORD:{csv,3mf}", "INT:INT in [0 - 4096]", "A:B".
void read_type(const std::string& type, ValueReference& value) {
    value.hint = type;
    if (const std::size_t set = type.find(":{"); set != std::string::npos) {
        value.hint = type.substr(0, set);
        value.words = split(std::string_view(type).substr(set + 2, type.size() - set - 3), ',');
    } else if (const std::size_t range = type.find(" in ["); range != std::string::npos) {
        value.hint = type.substr(0, type.rfind(':', range));
        value.accepted = type.substr(range + 5, type.size() - range - 6);
        if (const std::size_t dash = value.accepted.find(" - "); dash != std::string::npos)
            value.accepted.replace(dash, 3, " to ");
    } else if (type.starts_with('{')) {
        value.hint.clear();
        value.words = split(std::string_view(type).substr(1, type.size() - 2), ',');
    }
}

std::vector<std::string> material_names() {
    std::vector<std::string> names;
    for (const BaseMaterial& material : shipped_material_list()) names.push_back(material.name);
    return names;
}

std::vector<std::string> section_names() {
    std::vector<std::string> names;
    for (const Section& section : sections()) names.push_back(section.name);
    return names;
}

std::vector<std::string> subcommand_names(const CLI::App& root) {
    std::vector<std::string> names;
    for (const CLI::App* command : root.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

ValueKind kind_of_hint(std::string_view hint) {
    if (hint == "FILE") return ValueKind::file;
    if (hint == "DIR") return ValueKind::folder;
    if (hint == "DEVICE") return ValueKind::port;
    return hint.starts_with("PATH") ? ValueKind::output : ValueKind::free;
}

/// What is known of an option beyond its type: the words of a setting, names that the program ships.
void read_option_words(const OptionReference& option, ValueReference& value) {
    const Setting* setting = setting_of(option);
    if (!setting) return;
    if (setting->name() == "material.name") value.words = material_names();
    if (setting->name() == "printer.profile") value.kind = ValueKind::machine;
    if (setting->type == ValueType::choice) value.words = setting->choices;
}

/// The same of a place of the command line.
void read_place_words(const CLI::App& root, const OptionReference& place, ValueReference& value) {
    const std::string& name = place.names.front();
    if (name == "INPUT" || name == "JOB") value.kind = ValueKind::file;
    if (name == "NAME") value.kind = ValueKind::machine;
    if (name == "SECTION") value.words = section_names();
    if (name == "COMMAND") value.words = subcommand_names(root);
}

OptionReference read_option(const CLI::App& root, const CLI::Option& option) {
    OptionReference read;
    for (const std::string& name : option.get_snames()) read.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) read.names.push_back("--" + name);
    const bool is_place = option.get_positional();
    if (is_place) read.names = {option.get_name(true, false)};
    read.group = option.get_group();
    read.help = option.get_description();
    read.required = option.get_required();
    read.repeats = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    ValueReference& value = read.value;
    if (option.get_type_size() == 0 || option.get_expected_min() == 0) return read;  // a flag
    read_type(option.get_type_name(), value);
    value.kind = kind_of_hint(value.hint);
    if (is_place)
        read_place_words(root, read, value);
    else
        read_option_words(read, value);
    if (!value.words.empty()) value.kind = ValueKind::words;
    if (value.kind == ValueKind::file) value.endings = endings_in(read.help);
    value.takes_several = option.get_expected_max() == CLI::detail::expected_max_vector_size;
    return read;
}

/// The examples and what stands below them.
void read_footer(std::string_view footer, CommandReference& command) {
    if (!footer.starts_with(examples_heading)) return;
    for (const std::string& line : split(footer.substr(examples_heading.size()), '\n')) {
        if (line.starts_with("  "))
            command.examples.push_back(line.substr(2));
        else
            command.notes += (command.notes.empty() ? "" : " ") + line;
    }
}

CommandReference read_command(const CLI::App& root, const CLI::App& app) {
    CommandReference command;
    if (&app != &root) command.name = app.get_name();
    command.help = app.get_description();
    for (const CLI::Option* option : app.get_options()) {
        OptionReference read = read_option(root, *option);
        (option->get_positional() ? command.places : command.options).push_back(std::move(read));
    }
    read_footer(app.get_footer(), command);
    return command;
}

}  // namespace

ProgramReference read_reference(const CLI::App& root) {
    ProgramReference reference;
    reference.program = read_command(root, root);
    for (const CLI::App* command : root.get_subcommands({}))
        reference.commands.push_back(read_command(root, *command));
    reference.machines = MachineProfiles().names();
    return reference;
}

bool is_recipe_option(const OptionReference& option) { return option.group.starts_with(recipe_group); }

std::vector<std::string> option_names(const CommandReference& command, bool of_recipe) {
    std::vector<std::string> names;
    for (const OptionReference& option : command.options) {
        if (is_recipe_option(option) == of_recipe) std::ranges::copy(option.names, std::back_inserter(names));
    }
    return names;
}

std::vector<std::string> command_names(const ProgramReference& reference) {
    std::vector<std::string> names;
    for (const CommandReference& command : reference.commands) names.push_back(command.name);
    return names;
}

}  // namespace lamella
