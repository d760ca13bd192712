// The completion script for bash.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "app/help/completion_scripts.h"

namespace lamella {
namespace {

/// Words without blanks and quotes, as one quoted word.
std::string bash_quoted(const std::vector<std::string>& words) {
    return fmt::format("'{}'", fmt::join(words, " "));
}

/// The assignments that tell the script what a value is.
std::string bash_value(const ValueReference& value) {
    std::string text = "kind=";
    switch (value.kind) {
        case ValueKind::none:
            return text + "none";
        case ValueKind::free:
            return text + "free";
        case ValueKind::words:
            text += "words words=" + bash_quoted(value.words);
            break;
        case ValueKind::file: {
            text += "file";
            std::vector<std::string> endings = value.endings;
            for (const std::string& ending : value.endings) {
                std::string& upper = endings.emplace_back(ending);
                for (char& c : upper) c = 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
            }
            if (!endings.empty()) text += " words=" + bash_quoted(endings);
            break;
        }
        case ValueKind::folder:
            text += "folder";
            break;
        case ValueKind::output:
            text += "output";
            break;
        case ValueKind::machine:
            text += "machine";
            break;
        case ValueKind::port:
            text += "port";
            break;
    }
    return text + (value.takes_several ? " several=yes" : "");
}

/// The branches of a `case` over COMMAND:OPTION and COMMAND:PLACE. A value that an option has in all commands
/// is told once.
std::string bash_value_branches(const ProgramReference& reference) {
    std::map<std::string, std::map<std::string, std::string>> by_option;   // option, command: value
    std::vector<std::string> options;                                      // in the order of the help
    std::vector<std::pair<std::string, std::vector<std::string>>> values;  // value: patterns
    const auto add = [&](const std::string& value, const std::string& pattern) {
        auto found =
            std::ranges::find(values, value, &std::pair<std::string, std::vector<std::string>>::first);
        if (found == values.end()) found = values.insert(found, {value, {}});
        found->second.push_back(pattern);
    };
    for (const CommandReference& command : reference.commands) {
        for (std::size_t i = 0; i < command.places.size(); ++i)
            add(bash_value(command.places[i].value), fmt::format("{}:{}", command.name, i));
        for (const OptionReference& option : command.options) {
            for (const std::string& name : option.names) {
                if (!by_option.contains(name)) options.push_back(name);
                by_option[name][command.name] = bash_value(option.value);
            }
        }
    }
    for (const std::string& name : options) {
        const auto& commands = by_option[name];
        const std::string& first = commands.begin()->second;
        if (std::ranges::all_of(commands, [&](const auto& entry) { return entry.second == first; })) {
            if (first != "kind=free") add(first, "*:" + name);
            continue;
        }
        for (const auto& [command, value] : commands) add(value, fmt::format("{}:{}", command, name));
    }
    std::string text;
    for (const auto& [value, patterns] : values)
        text += fmt::format("        {}) {} ;;\n", fmt::join(patterns, " | "), value);
    return text;
}

/// The branches of a `case` over commands, with the options of each.
std::string bash_option_branches(const ProgramReference& reference, const std::vector<std::string>& shared) {
    std::string text;
    for (const CommandReference& command : reference.commands) {
        const std::vector<std::string> recipe = option_names(command, true);
        std::string words = fmt::format("{}", fmt::join(option_names(command, false), " "));
        if (!recipe.empty())
            words += recipe == shared ? " $recipe" : fmt::format(" {}", fmt::join(recipe, " "));
        text += fmt::format("        {}) words=\"{}\" ;;\n", command.name, words);
    }
    return text;
}

/// The options of recipe keys, which are told once.
std::vector<std::string> shared_options(const ProgramReference& reference) {
    for (const CommandReference& command : reference.commands) {
        if (auto names = option_names(command, true); !names.empty()) return names;
    }
    return {};
}

constexpr const char* bash_helpers = R"bash(
# Offers the words behind the first that begin with the first.
_lamella_offer() {
    local word
    for word in "${@:2}"; do
        [[ $word == "$1"* ]] && COMPREPLY+=("$word")
    done
    return 0
}

# Offers folders, and files with one of the endings behind the first word; all files where none has one.
_lamella_offer_files() {
    local file ending other=() found=
    compopt -o filenames -o default 2>/dev/null  # bash 3.2 has no compopt
    while IFS= read -r file; do
        if [[ -d ${file/#\~/$HOME} ]]; then
            COMPREPLY+=("$file")
            continue
        fi
        for ending in "${@:2}"; do
            [[ $file == *"$ending" ]] && COMPREPLY+=("$file") found=yes && continue 2
        done
        other+=("$file")
    done < <(compgen -f -- "$1")
    [[ $found ]] || COMPREPLY+=(${other[@]+"${other[@]}"})
}

_lamella_offer_folders() {
    local folder
    compopt -o filenames -o dirnames 2>/dev/null
    while IFS= read -r folder; do COMPREPLY+=("$folder"); done < <(compgen -d -- "$1")
}

# Offers what is built in, and the profiles in the user's folder.
_lamella_offer_machines() {
    local file
    _lamella_offer "$1" $_lamella_machines
    for file in "${XDG_CONFIG_HOME:-$HOME/.config}"/lamella/printers/*.toml; do
        [[ -e $file ]] && file=${file##*/} && _lamella_offer "$1" "${file%.toml}"
    done
    return 0
}

_lamella_offer_ports() {
    local port
    for port in /dev/serial/by-id/* /dev/ttyUSB* /dev/ttyACM*; do
        [[ -e $port ]] && _lamella_offer "$1" "$port"
    done
    [[ ${COMPREPLY[*]} ]] || _lamella_offer_files "$1"
}
)bash";

constexpr const char* bash_main = R"bash(
_lamella() {
    local IFS=$' \t\n' word command= option= joined= kind= words= several= place=0 i
    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    # Bash takes = : and @ for words: --foam=gyroid, 0:400 and part.sl1@prusa-sl1s are three words each.
    for ((i = 1; i < COMP_CWORD; ++i)); do
        word=${COMP_WORDS[i]}
        if [[ $word == = ]]; then
            continue
        elif [[ $word == [:@]* ]]; then
            joined=yes
        elif [[ $joined ]]; then
            joined=
        elif [[ ! $command ]]; then
            [[ $word == -* ]] || command=$word
        elif [[ $word == -* && ( ! $option || $several ) ]]; then
            option=$word several=
            _lamella_value "$command" "$option"
            [[ $kind == none ]] && option=
        elif [[ ! $option ]]; then
            place=$((place + 1))
        elif [[ ! $several ]]; then
            option=
        fi
    done
    if [[ $current == @ || $before == @ ]]; then
        _lamella_offer_machines "${current#@}"
        return
    fi
    [[ $current == : || $before == : ]] && return
    [[ $current == = ]] && current=
    if [[ ! $command ]]; then
        _lamella_offer "$current" $_lamella_commands
        return
    fi
    [[ $several && $current == -* ]] && option=
    kind=free words=
    if [[ $option ]]; then
        _lamella_value "$command" "$option"
    elif [[ $current != -* ]]; then
        _lamella_value "$command" "$place"
    fi
    # Where no more words are expected, options are shown.
    if [[ ! $option && $kind == free ]]; then
        _lamella_options "$command"
        kind=words
    fi
    case $kind in
        words) _lamella_offer "$current" $words ;;
        file) _lamella_offer_files "$current" $words ;;
        output) _lamella_offer_files "$current" ;;
        folder) _lamella_offer_folders "$current" ;;
        port) _lamella_offer_ports "$current" ;;
        machine)
            _lamella_offer_machines "$current"
            [[ ${COMPREPLY[*]} ]] || _lamella_offer_files "$current" .toml
            ;;
    esac
}

complete -F _lamella lamella
)bash";

}  // namespace

std::string bash_completion(const ProgramReference& reference) {
    const std::vector<std::string> shared = shared_options(reference);
    std::vector<std::string> first = command_names(reference);
    std::ranges::copy(option_names(reference.program, false), std::back_inserter(first));
    std::string text =
        "# Completion of lamella " LAMELLA_VERSION " for bash; made by `lamella completion bash`.\n\n";
    text += "_lamella_commands=" + bash_quoted(first) + "\n";
    text += "_lamella_machines=" + bash_quoted(reference.machines) + "\n\n";
    text += "# Sets words to the options of a command.\n_lamella_options() {\n";
    text += "    local recipe=" + bash_quoted(shared) + "\n    words=\n    case $1 in\n";
    text += bash_option_branches(reference, shared) + "    esac\n}\n\n";
    text += "# Sets what an option of a command takes, or what stands at a place counted from 0.\n";
    text += "_lamella_value() {\n    kind=free words= several=\n    case $1:$2 in\n";
    text += bash_value_branches(reference) + "    esac\n}\n";
    return text + bash_helpers + bash_main;
}

}  // namespace lamella
