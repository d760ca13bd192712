// The completion script for fish: one `complete` an option, told once for all commands that have it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "app/help/completion_scripts.h"

namespace lamella {
namespace {

std::string fish_quoted(std::string_view text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') result += '\\';
        result += c;
    }
    return result + "'";
}

/// What follows an option, or stands at a place, as arguments of `complete`.
std::string fish_value(const ValueReference& value) {
    switch (value.kind) {
        case ValueKind::none:
            return "";
        case ValueKind::free:
            return " -x";
        case ValueKind::words:
            return " -x -a " + fish_quoted(fmt::format("{}", fmt::join(value.words, " ")));
        case ValueKind::file:
            return " -x -k -a " +
                   fish_quoted(fmt::format("(__lamella_files {})", fmt::join(value.endings, " ")));
        case ValueKind::folder:
            return " -x -a '(__fish_complete_directories)'";
        case ValueKind::output:
            return " -x -a '(__lamella_outputs)'";
        case ValueKind::machine:
            return " -x -k -a '(__lamella_machines; __lamella_files .toml)'";
        case ValueKind::port:
            return " -x -a '(__lamella_ports)'";
    }
    return "";
}

/// " -s o -l output -d 'Output file' -r"
std::string fish_option(const OptionReference& option) {
    std::string text;
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        text += fmt::format(" -{} {}", is_long ? 'l' : 's', name.substr(is_long ? 2 : 1));
    }
    // The menu has one line an option: of a recipe key without what it accepts.
    const std::size_t end = is_recipe_option(option) ? option.help.find(" Accepts ") : option.help.size();
    return text + " -d " + fish_quoted(option.help.substr(0, end)) + fish_value(option.value);
}

constexpr const char* fish_helpers = R"fish(
# Whether the command is one of those given.
function __lamella_in
    for word in (commandline -opc)[2..-1]
        string match -q -- '-*' $word; and continue
        contains -- $word $argv
        return
    end
    return 1
end

# Whether there is no command yet.
function __lamella_first
    for word in (commandline -opc)[2..-1]
        string match -q -- '-*' $word; or return 1
    end
end

# Folders, and files with one of the endings given; all files where none has one.
function __lamella_files
    set -l offered
    set -l other
    set -l found
    for file in (complete -C "'' "(commandline -ct))
        if string match -q -- '*/' $file
            set -a offered $file
            continue
        end
        set -l ending (string lower -- (path extension -- (string split -f 1 \t -- $file)))
        if contains -- "$ending" $argv
            set -a offered $file
            set found yes
        else
            set -a other $file
        end
    end
    test -n "$found"; or set -a offered $other
    printf '%s\n' $offered
end

# What is built in, and the profiles in the user's folder.
function __lamella_machines
    printf '%s\n' $__lamella_machine_list
    set -l config $XDG_CONFIG_HOME
    test -n "$config"; or set config ~/.config
    for file in $config/lamella/printers/*.toml
        path change-extension '' -- (path basename -- $file)
    end
end

# A file to make; behind "@" a machine.
function __lamella_outputs
    set -l token (commandline -ct)
    if string match -q -- '*@*' $token
        printf '%s\n' (string replace -r '@[^@]*$' '@' -- $token)(__lamella_machines)
    else
        __lamella_files
    end
end

function __lamella_ports
    set -l ports /dev/serial/by-id/* /dev/ttyUSB* /dev/ttyACM*
    printf '%s\n' $ports
end

complete -c lamella -f
)fish";

}  // namespace

std::string fish_completion(const ProgramReference& reference) {
    std::string text = "# Completion of lamella " LAMELLA_VERSION
                       " for fish, 3.5 or later; made by `lamella completion fish`.\n\n";
    text += fmt::format("set -g __lamella_machine_list {}\n", fmt::join(reference.machines, " "));
    text += fish_helpers;
    for (const OptionReference& option : reference.program.options)
        text += "complete -c lamella -n __lamella_first" + fish_option(option) + "\n";
    for (const CommandReference& command : reference.commands)
        text += fmt::format("complete -c lamella -n __lamella_first -a {} -d {}\n", command.name,
                            fish_quoted(command.help));
    std::vector<std::pair<std::string, std::vector<std::string>>> lines;  // arguments: commands
    const auto add = [&](const std::string& arguments, const std::string& command) {
        auto found = std::ranges::find(lines, arguments, [](const auto& line) { return line.first; });
        if (found == lines.end()) found = lines.insert(found, {arguments, {}});
        if (found->second.empty() || found->second.back() != command) found->second.push_back(command);
    };
    for (const CommandReference& command : reference.commands) {
        for (const OptionReference& place : command.places) add(fish_value(place.value), command.name);
        for (const OptionReference& option : command.options) add(fish_option(option), command.name);
    }
    for (const auto& [arguments, commands] : lines)
        text +=
            fmt::format("complete -c lamella -n '__lamella_in {}'{}\n", fmt::join(commands, " "), arguments);
    return text;
}

}  // namespace lamella
