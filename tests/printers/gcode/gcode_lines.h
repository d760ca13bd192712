// Lines of G-code taken apart by a reader of the tests' own.
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella::test {

/// A line's command and words; comments apart.
struct GcodeLine {
    std::string text;
    std::string command;  ///< empty for a comment
    std::map<char, double> words;

    bool has(char letter) const { return words.contains(letter); }
};

inline std::vector<GcodeLine> gcode_lines(const std::string& text) {
    std::vector<GcodeLine> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        GcodeLine& parsed = lines.emplace_back();
        parsed.text = line;
        std::istringstream words(line.substr(0, line.find(';')));
        words >> parsed.command;
        const bool plain = !parsed.command.empty() &&
                           (parsed.command[0] == 'G' || parsed.command[0] == 'M') &&
                           parsed.command != "M117";  // a text follows
        for (std::string word; plain && words >> word;) parsed.words[word[0]] = std::stod(word.substr(1));
    }
    return lines;
}

/// A move in the plane with all that holds while it is made. Arcs have a turn (1 counter-clockwise).
struct PlaneMove {
    std::string command;
    dvec2 from{0}, to{0};
    double length = 0;
    double speed = 0;  ///< mm/s
    double filament = 0;
    double power = 0;  ///< S, modal, until the beam is switched
    double z = 0;
    int layer = -1;
    std::string role;
};

inline double arc_length(dvec2 from, dvec2 to, dvec2 center, bool counter_clockwise) {
    const dvec2 a = from - center, b = to - center;
    double sweep = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    if (!counter_clockwise) sweep = -sweep;
    if (sweep < 0) sweep += 2 * pi;
    return sweep * glm::length(a);
}

inline std::vector<PlaneMove> plane_moves(const std::string& text) {
    std::vector<PlaneMove> moves;
    PlaneMove now;
    for (const GcodeLine& line : gcode_lines(text)) {
        if (line.text == ";LAYER_CHANGE" || line.text.starts_with(";LAYER:")) ++now.layer;
        if (line.text.starts_with(";TYPE:")) now.role = line.text.substr(6);
        if (line.command == "M3" || line.command == "M4" || line.command == "M5") now.power = 0;
        if (line.command.size() != 2 || line.command[0] != 'G') continue;
        if (line.has('F')) now.speed = line.words.at('F') / 60;
        if (line.has('S')) now.power = line.words.at('S');
        if (line.has('Z')) now.z = line.words.at('Z');
        if (!line.has('X')) continue;
        now.command = line.command;
        now.to = {line.words.at('X'), line.words.at('Y')};
        now.filament = line.has('E') ? line.words.at('E') : 0;
        now.length = glm::distance(now.from, now.to);
        if (line.has('I'))
            now.length =
                arc_length(now.from, now.to, now.from + dvec2(line.words.at('I'), line.words.at('J')),
                           line.command == "G3");
        moves.push_back(now);
        now.from = now.to;
    }
    return moves;
}

/// What a comment "; NAME = VALUE" says; NaN where there is none.
inline double gcode_fact(const std::string& text, const std::string& name) {
    const std::string key = "\n; " + name + " = ";
    const std::size_t at = text.find(key);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + key.size()));
}

}  // namespace lamella::test
