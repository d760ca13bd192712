// The completion script for zsh: one call of _arguments a command.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "app/help/completion_scripts.h"

namespace lamella {
namespace {

/// Puts a backslash before some characters.
std::string escaped(std::string_view text, std::string_view special) {
    std::string result;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) result += '\\';
        result += c;
    }
    return result;
}

std::string zsh_quoted(std::string_view text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

/// A help as a line of a menu: of a recipe key without what it accepts.
std::string menu_line(const OptionReference& option) {
    return option.help.substr(0,
                              is_recipe_option(option) ? option.help.find(" Accepts ") : option.help.size());
}

std::string zsh_action(const ValueReference& value) {
    switch (value.kind) {
        case ValueKind::none:
            break;
        case ValueKind::free:
            return " ";  // a message, and nothing to choose
        case ValueKind::words:
            return fmt::format("({})", fmt::join(value.words, " "));
        case ValueKind::file: {
            if (value.endings.empty()) return "_files";
            std::string patterns;
            for (const std::string& ending : value.endings)
                patterns += (patterns.empty() ? "" : "|") + ending.substr(1);
            return fmt::format("_files -g \"(#i)*.({})\"", patterns);
        }
        case ValueKind::folder:
            return "_files -/";
        case ValueKind::output:
            return "_lamella_outputs";
        case ValueKind::machine:
            return "_lamella_machines";
        case ValueKind::port:
            return "_lamella_ports";
    }
    return "";
}

/// ":MM:action": what _arguments wants behind an option or a place.
std::string zsh_value(const ValueReference& value, const std::string& name) {
    if (value.kind == ValueKind::none) return "";
    return fmt::format(":{}{}:{}", value.takes_several ? "*-*:" : "",
                       escaped(value.hint.empty() ? name : value.hint, ":\\"), zsh_action(value));
}

/// '(-o --output)'{-o,--output=}'[help]:FILE:_files'
std::string zsh_option(const OptionReference& option) {
    const bool has_value = option.value.kind != ValueKind::none;
    std::vector<std::string> forms;
    for (const std::string& name : option.names)
        forms.push_back(name + (has_value && name.starts_with("--") ? "=" : ""));
    const std::string tail =
        "[" + escaped(menu_line(option), "[]\\") + "]" + zsh_value(option.value, "value");
    const std::string before = option.repeats ? "*" : "";
    if (forms.size() == 1) return zsh_quoted(before + forms.front() + tail);
    const std::string excluded = option.repeats ? "*" : fmt::format("({})", fmt::join(option.names, " "));
    return fmt::format("{}{{{}}}{}", zsh_quoted(excluded), fmt::join(forms, ","), zsh_quoted(tail));
}

std::string zsh_options(const CommandReference& command, bool of_recipe, const std::string& indent) {
    std::string text;
    for (const OptionReference& option : command.options) {
        if (is_recipe_option(option) == of_recipe) text += indent + zsh_option(option);
    }
    return text;
}

std::string zsh_places(const CommandReference& command, const std::string& indent) {
    std::string text;
    for (std::size_t i = 0; i < command.places.size(); ++i) {
        const OptionReference& place = command.places[i];
        text += indent + zsh_quoted(fmt::format("{}{}{}", i + 1, place.required ? "" : ":",
                                                zsh_value(place.value, place.names.front())));
    }
    return text;
}

/// The branches of a `case` over commands. Options of recipe keys stand in an array that all share.
std::string zsh_branches(const ProgramReference& reference, const std::string& shared) {
    std::string text;
    for (const CommandReference& command : reference.commands) {
        const std::string indent = " \\\n                ";
        text += "        " + command.name +
                ")\n            _arguments -s :" + zsh_options(command, false, indent) +
                zsh_places(command, indent);
        if (const std::string own = zsh_options(command, true, "\n        "); !own.empty())
            text += own == shared ? indent + "$recipe" : zsh_options(command, true, indent);
        text += "\n            ;;\n";
    }
    return text;
}

std::string zsh_shared(const ProgramReference& reference) {
    for (const CommandReference& command : reference.commands) {
        if (std::string text = zsh_options(command, true, "\n        "); !text.empty()) return text;
    }
    return "";
}

constexpr const char* zsh_helpers = R"zsh(
# Those built in, and the profiles in the user's folder.
_lamella_machine_names() {
    local -a names=($_lamella_machine_list ${XDG_CONFIG_HOME:-$HOME/.config}/lamella/printers/*.toml(N:t:r))
    local expl
    _wanted machines expl 'machine profile' compadd -a names
}

_lamella_machines() {
    _lamella_machine_names || _files -g '*.toml'
}

_lamella_outputs() {
    if compset -P '*@'; then
        _lamella_machine_names
    else
        _files
    fi
}

_lamella_ports() {
    local -a ports=(/dev/serial/by-id/*(N) /dev/ttyUSB*(N) /dev/ttyACM*(N))
    local expl
    _wanted ports expl 'serial port' compadd -a ports || _files
}
)zsh";

constexpr const char* zsh_main = R"zsh(
# The file of a function on fpath is its first call; a sourced one registers it.
if [[ $funcstack[1] == _lamella ]]; then
    _lamella "$@"
else
    compdef _lamella lamella
fi
)zsh";

}  // namespace

std::string zsh_completion(const ProgramReference& reference) {
    const std::string shared = zsh_shared(reference);
    std::string text = "#compdef lamella\n# Completion of lamella " LAMELLA_VERSION
                       " for zsh; made by `lamella completion zsh`.\n\n";
    text += fmt::format("typeset -ga _lamella_machine_list=(\n    {}\n)\n",
                        fmt::join(reference.machines, "\n    "));
    text += zsh_helpers;
    text += "\n_lamella_commands() {\n    local -a commands=(";
    for (const CommandReference& command : reference.commands)
        text += "\n        " + zsh_quoted(command.name + ":" + command.help);
    text += "\n    )\n    _describe -t commands command commands\n}\n";
    text += "\n_lamella_arguments() {\n    local -a recipe=(" + shared + "\n    )\n    case $words[1] in\n";
    text += zsh_branches(reference, shared) + "    esac\n}\n";
    text += "\n_lamella() {\n    local curcontext=$curcontext state line\n    typeset -A opt_args\n";
    text += "    _arguments -C" + zsh_options(reference.program, false, " \\\n        ") +
            " \\\n        '1:command:_lamella_commands' \\\n        '*::argument:_lamella_arguments'\n}\n";
    return text + zsh_main;
}

}  // namespace lamella
