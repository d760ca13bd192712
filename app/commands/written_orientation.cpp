// Edits the lines of the [part] table.
#include "app/commands/written_orientation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
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

}  // namespace

std::string lay_on_text(dvec3 direction) {
    return number(direction.x) + "," + number(direction.y) + "," + number(direction.z);
}

void write_orientation(const std::string& recipe, dvec3 lay_on) {
    if (std::filesystem::path(recipe).extension() != ".toml") {
        throw InputError("--write: " + (recipe.empty() ? "no recipe is given" : recipe + " is no recipe") +
                         "; accepted: a .toml file, or --lay-on=" + lay_on_text(lay_on) +
                         " with the other commands");
    }
    static const std::regex header(R"(\s*\[\s*part\s*\]\s*(#.*)?\s*)"), table(R"(\s*\[.*)"),
        ours(R"(\s*(lay_on|lay_on_at|turn)\s*=.*)"),
        whole(R"([^\[\]#]*=\s*(\[[^\[\]]*\]|\[\s*\[[^\[\]]*\]\s*,?\s*\])\s*(#.*)?\s*)");
    std::string text;
    bool is_in_part = false, is_written = false;
    for (const std::string& line : lines_of(whole_file(recipe, "a recipe"))) {
        const std::string content = line.substr(0, line.find_last_not_of("\r\n") + 1);
        if (std::regex_match(content, header)) {
            text += content + "\nlay_on = [" + number(lay_on.x) + ", " + number(lay_on.y) + ", " +
                    number(lay_on.z) + "]\n";
            is_in_part = is_written = true;
            continue;
        }
        if (std::regex_match(content, table)) is_in_part = false;
        if (is_in_part && std::regex_match(content, ours)) {
            if (!std::regex_match(content, whole))
                throw InputError(
                    fmt::format("--write: {} has a value of [part] on several lines: {}", recipe, content));
            continue;
        }
        text += line;
    }
    if (!is_written)
        throw InputError("--write: " + recipe + " has no [part] table; accepted: lay_on = [" +
                         lay_on_text(lay_on) + "] by hand");
    write_complete_file(recipe, [&](std::ostream& out) { out << text; });
}

}  // namespace lamella
