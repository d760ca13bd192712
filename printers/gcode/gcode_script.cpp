// Expands variables in braces and reports mistakes.
#include "printers/gcode/gcode_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/gcode/gcode_flavour.h"

namespace lamella {
namespace {

struct Variable {
    std::string_view name;
    std::string (*text)(const ScriptValues&);
};

constexpr std::array variables{
    Variable{"layer", [](const ScriptValues& v) { return std::to_string(v.layer); }},
    Variable{"layers", [](const ScriptValues& v) { return std::to_string(v.layers); }},
    Variable{"z", [](const ScriptValues& v) { return format_number(v.z, 3); }},
    Variable{"height", [](const ScriptValues& v) { return format_number(v.height, 3); }},
    Variable{"nozzle_temperature",
             [](const ScriptValues& v) { return format_number(v.nozzle_temperature, 0); }},
    Variable{"bed_temperature", [](const ScriptValues& v) { return format_number(v.bed_temperature, 0); }},
    Variable{"nozzle", [](const ScriptValues& v) { return format_number(v.nozzle, 3); }},
    Variable{"bed_x", [](const ScriptValues& v) { return format_number(v.bed_x, 3); }},
    Variable{"bed_y", [](const ScriptValues& v) { return format_number(v.bed_y, 3); }},
    Variable{"bed_z", [](const ScriptValues& v) { return format_number(v.bed_z, 3); }},
    Variable{"filament_used", [](const ScriptValues& v) { return format_number(v.filament_used, 2); }},
    Variable{"tool", [](const ScriptValues& v) { return std::to_string(v.tool); }},
    Variable{"previous_tool", [](const ScriptValues& v) { return std::to_string(v.previous_tool); }},
};

/// Longer than the values of any print.
const ScriptValues longest_values{9'999'999, 9'999'999, 9999.999,  99.999,         999, 999, 9.999,
                                  99999.999, 99999.999, 99999.999, 999'999'999.99, 99,  99};

/// Returns a line with variables replaced; a mistake is described in `mistake`.
std::string expand_line(std::string_view line, const ScriptValues& values, std::string& mistake) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        const bool doubled = i + 1 < line.size() && line[i + 1] == c;
        if (c != '{' && c != '}') {
            out += c;
        } else if (doubled) {
            out += c;
            ++i;
        } else if (c == '}') {
            mistake = "a brace } closes nothing; accepted: {variables}, and }} for a brace";
            return out;
        } else {
            const std::size_t end = line.find('}', i);
            const std::string_view name =
                line.substr(i + 1, end == std::string_view::npos ? end : end - i - 1);
            const auto* found = std::ranges::find(variables, name, &Variable::name);
            if (end == std::string_view::npos || found == variables.end()) {
                std::string known;
                for (const Variable& p : variables) known += fmt::format(" {{{}}}", p.name);
                mistake = fmt::format("there is no variable {{{}}}; accepted:{}, and {{{{ for a brace",
                                      name.substr(0, 64), known);
                return out;
            }
            out += found->text(values);
            i = end;
        }
    }
    return out;
}

/// Calls `take` with each line and its number (from 1) until it returns false.
template <typename Take>
void for_lines(std::string_view script, Take take) {
    int number = 1;
    for (std::size_t at = 0; at < script.size(); ++number) {
        const std::size_t end = std::min(script.find('\n', at), script.size());
        if (!take(script.substr(at, end - at), number)) return;
        at = end + 1;
    }
}

}  // namespace

std::optional<std::string> script_mistake(std::string_view script, Flavour flavour) {
    std::string found;
    for_lines(script, [&](std::string_view line, int number) {
        std::string mistake;
        const std::string text = expand_line(line, longest_values, mistake);
        if (std::ranges::any_of(line, [](char c) { return c < ' ' || c > '~'; })) {
            mistake = "a character is not printable ASCII; accepted: letters, digits and signs of ASCII";
        } else if (flavour == Flavour::grbl && line.find_first_of("!~?") != std::string_view::npos) {
            mistake = fmt::format(
                "GRBL acts on {} as soon as it arrives, even in a comment; accepted: lines without ! ~ ?",
                line[line.find_first_of("!~?")]);
        } else if (mistake.empty() && text.size() > longest_line(flavour)) {
            mistake =
                fmt::format("it has up to {} bytes; accepted: at most {}, which is what the firmware reads",
                            text.size(), longest_line(flavour));
        }
        if (!mistake.empty()) found = fmt::format("line {}: {}", number, mistake);
        return found.empty();
    });
    if (found.empty()) return std::nullopt;
    return found;
}

std::string expand_script(std::string_view script, const ScriptValues& values) {
    std::string out;
    for_lines(script, [&](std::string_view line, int) {
        std::string mistake;
        (out += expand_line(line, values, mistake)) += '\n';
        return true;
    });
    return out;
}

void check_scripts(const GcodeProfile& profile) {
    for (const auto& [key, script] :
         {std::pair("start_script", &profile.start_script), std::pair("layer_script", &profile.layer_script),
          std::pair("end_script", &profile.end_script), std::pair("tool_script", &profile.tool_script)}) {
        if (const auto mistake = script_mistake(*script, profile.flavour))
            throw InputError(fmt::format("{}, {}", key, *mistake));
    }
}

std::string start_script(const GcodeProfile& profile) {
    return profile.start_script.empty() ? std::string(default_start_script(profile.flavour))
                                        : profile.start_script;
}
std::string layer_script(const GcodeProfile& profile) {
    return profile.layer_script.empty() ? std::string(default_layer_script(profile.flavour))
                                        : profile.layer_script;
}
std::string end_script(const GcodeProfile& profile) {
    return profile.end_script.empty() ? std::string(default_end_script(profile.flavour)) : profile.end_script;
}

std::string tool_script(const GcodeProfile& profile) {
    return profile.tool_script.empty() ? std::string(default_tool_script) : profile.tool_script;
}

}  // namespace lamella
