#include "app/help/command_help.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace lamella {
namespace {

constexpr std::string_view common_group = "Recipe, the keys that most jobs need";
constexpr auto common_options =
    std::to_array<std::string_view>({"--mesh",           "--unit",
                                     "--scale",          "--shape",
                                     "--shape-size",     "--shape-radius",
                                     "--foam",           "--cell",
                                     "--beam",           "--wall",
                                     "--modulus",        "--material",
                                     "--frame",          "--skin",
                                     "--skin-pattern",   "--drop-islands",
                                     "--cavity-wall",    "--layer-height",
                                     "--support",        "--check-process",
                                     "--copies",         "--printer",
                                     "--printer-kind",   "--printer-pixel",
                                     "--printer-nozzle", "--printer-infill-density",
                                     "--printer-walls"});

/// Returns the section whose keys a command's help shows in full.
std::string own_section(const CLI::App& command) {
    if (command.get_name() == "supports") return "[support]";
    return command.get_name() == "check" ? "[check]" : "";
}

bool is_common(const CLI::Option& option) {
    return std::ranges::any_of(common_options, [&](std::string_view name) {
        return option.check_lname(std::string(name.substr(2)));
    });
}

/// Hides rarely needed recipe options. Returns the sections with hidden options, with their number.
std::vector<std::pair<std::string, int>> hide_uncommon(CLI::App& command) {
    std::vector<std::pair<std::string, int>> hidden;
    for (CLI::Option* option : command.get_options()) {
        const std::string group = option->get_group();
        if (!group.starts_with(recipe_group)) continue;
        const std::string section = group.substr(recipe_group.size() - 1);
        if (is_common(*option) || section == own_section(command)) {
            const std::string text = option->get_description();
            option->description(text.substr(0, text.find(" Accepts ")));
            if (section != own_section(command)) option->group(std::string(common_group));
            continue;
        }
        if (hidden.empty() || hidden.back().first != section) hidden.emplace_back(section, 0);
        ++hidden.back().second;
        option->group("");  // hides it
    }
    return hidden;
}

/// Rewrites CLI11's text of a flag and its negation, --name{true},--no-name{false}, as --name,--no-name.
std::string without_values(std::string text) {
    for (const std::string_view value : {"{true}", "{false}"}) {
        for (std::size_t at = text.find(value); at != std::string::npos; at = text.find(value, at))
            text.erase(at, value.size());
    }
    return text;
}

}  // namespace

std::string exit_codes_line() {
    std::string line;
    for (const ExitCode& code : exit_codes)
        line += fmt::format("{}{} {}", line.empty() ? "Exit codes: " : ", ", code.code, code.meaning);
    return line + ".";
}

std::string help_text(CLI::App& command, HelpExtent extent) {
    const bool is_root = command.get_parent() == nullptr;
    if (extent == HelpExtent::common) {
        const auto hidden = hide_uncommon(command);
        if (!hidden.empty()) {
            std::string sections;
            for (const auto& [section, count] : hidden)
                sections += fmt::format("{}{} {}", sections.empty() ? "" : ", ", section, count);
            command.footer(fmt::format(
                "More options, by section of the recipe: {}.\n"
                "`lamella {} --help-all` shows them, `lamella keys SECTION` the keys of one section.\n\n{}",
                sections, command.get_name(), command.get_footer()));
        }
    }
    return without_values(command.help(is_root ? "" : "lamella"));
}

}  // namespace lamella
