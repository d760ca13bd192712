// Edits the lines of the [part] table.
#include "app/commands/written_orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"
#include "engine/base/whole_file.h"

namespace lamella {

namespace {

std::string number(double v) {
    const double rounded = std::round(v * 1e6) / 1e6;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        lines.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return lines;
}

/// Returns a line without a comment and the white space around it. None of the keys in question has a text.
std::string without_comment(const std::string& line) {
    constexpr const char* white = " \t\r\n";
    const std::string_view content = std::string_view(line).substr(0, line.find('#'));
    const std::size_t begin = content.find_first_not_of(white);
    if (begin == std::string_view::npos) return "";
    return std::string(content.substr(begin, content.find_last_not_of(white) + 1 - begin));
}

/// Returns what stands before the equals sign.
std::string key_of(const std::string& content) {
    const std::string key = content.substr(0, content.find('='));
    return key.substr(0, key.find_last_not_of(" \t") + 1);
}

}  // namespace

std::string lay_on_text(dvec3 direction) {
    return number(direction.x) + "," + number(direction.y) + "," + number(direction.z);
}

void check_is_recipe(const std::string& recipe) {
    if (std::filesystem::path(recipe).extension() == ".toml") return;
    throw InputError(fmt::format(
        "--write: {}; accepted: a .toml file, or no --write, and the list's lay_on as --lay-on= of the "
        "other commands",
        recipe.empty() ? "no recipe is given" : recipe + " is no recipe"));
}

void write_orientation(const std::string& recipe, dvec3 lay_on) {
    std::string text;
    bool is_in_part = false, is_written = false;
    for (const std::string& line : lines_of(whole_file(recipe, "a recipe"))) {
        const std::string content = without_comment(line);
        if (content.starts_with('[')) is_in_part = content == "[part]";
        const std::string key = is_in_part ? key_of(content) : "";
        if (key == "lay_on" || key == "lay_on_at" || key == "turn") {
            if (std::ranges::count(content, '[') != std::ranges::count(content, ']'))
                throw InputError(
                    fmt::format("--write: {} has a value of [part] on several lines: {}", recipe, content));
            continue;
        }
        text += line;
        if (is_in_part && content.starts_with('[')) {
            if (!line.ends_with('\n')) text += '\n';
            text +=
                fmt::format("lay_on = [{}, {}, {}]\n", number(lay_on.x), number(lay_on.y), number(lay_on.z));
            is_written = true;
        }
    }
    if (!is_written)
        throw InputError("--write: " + recipe + " has no [part] table; accepted: lay_on = [" +
                         lay_on_text(lay_on) + "] by hand");
    write_complete_file(recipe, [&](std::ostream& out) { out << text; });
}

}  // namespace lamella
