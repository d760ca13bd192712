// Interpreter of the words of GRBL.
#include "printers/serial/grbl_modes.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/number_format.h"

namespace lamella {
namespace {

bool is_one_of(double value, std::initializer_list<double> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

}  // namespace

double GrblModes::apply(std::string_view command) {
    // Settings and homing change no mode; $J= moves, but is only used by hand.
    if (command.empty() || command[0] == '$') return 0;
    named_ = {false, false};
    for (std::size_t at = 0; at < command.size();) {
        const char letter = command[at++];
        if (letter < 'A' || letter > 'Z') continue;
        while (at < command.size() && command[at] == ' ') ++at;
        double value = 0;
        const auto [end, error] =
            std::from_chars(command.data() + at, command.data() + command.size(), value);
        if (error != std::errc()) continue;
        at = static_cast<std::size_t>(end - command.data());
        take_word(letter, value);
    }
    return named_[0] || named_[1] ? move() : 0;
}

void GrblModes::take_word(char letter, double value) {
    const double unit = units_ == 20 ? 25.4 : 1;
    if (letter == 'G') {
        if (is_one_of(value, {0, 1, 2, 3})) motion_ = value;
        if (is_one_of(value, {17, 18, 19})) plane_ = value;
        if (is_one_of(value, {20, 21})) units_ = value;
        if (is_one_of(value, {90, 91})) distance_ = value;
        if (is_one_of(value, {93, 94})) feed_mode_ = value;
        if (is_one_of(value, {54, 55, 56, 57, 58, 59})) offset_ = value;
        if (is_one_of(value, {10, 28.1, 30.1, 43.1, 92}))
            obstacle_ = "it sets offsets of its own, which a reset may lose";
        if (is_one_of(value, {28, 30, 38.2, 38.3, 38.4, 38.5, 53}))
            obstacle_ = "it moves by the machine's own coordinates or by a probe, which cannot be followed";
    } else if (letter == 'M') {
        if (is_one_of(value, {3, 4, 5})) beam_ = value;
        if (is_one_of(value, {7, 8, 9})) coolant_ = value;
        if (is_one_of(value, {2, 30})) *this = GrblModes();
    } else if (letter == 'F') {
        feed_ = value * unit;
    } else if (letter == 'S') {
        power_ = value;
    } else if (letter == 'Z') {
        obstacle_ = "it moves its tool in z, which cannot be set down in the midst of a cut";
    } else if (letter == 'X' || letter == 'Y') {
        const std::size_t axis = letter == 'X' ? 0 : 1;
        way_[axis] = value * unit;
        named_[axis] = true;
    }
}

double GrblModes::move() {
    double way = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!named_[axis]) continue;
        const double to = distance_ == 91 ? at_[axis] + way_[axis] : way_[axis];
        way += (to - at_[axis]) * (to - at_[axis]);
        at_[axis] = to;
    }
    moved_ = true;
    return motion_ > 0 && feed_ > 0 && feed_mode_ == 94 ? std::sqrt(way) / feed_ * 60 : 0;
}

nlohmann::ordered_json GrblModes::to_json() const {
    return {{"x", at_[0]},       {"y", at_[1]},          {"moved", moved_},       {"motion", motion_},
            {"plane", plane_},   {"units", units_},      {"distance", distance_}, {"feed_mode", feed_mode_},
            {"offset", offset_}, {"beam", beam_},        {"coolant", coolant_},   {"feed", feed_},
            {"power", power_},   {"obstacle", obstacle_}};
}

GrblModes GrblModes::from_json(const nlohmann::ordered_json& json) {
    GrblModes modes;
    const auto read = [&](const char* name, auto& value) { json.at(name).get_to(value); };
    read("x", modes.at_[0]), read("y", modes.at_[1]), read("moved", modes.moved_);
    read("motion", modes.motion_), read("plane", modes.plane_), read("units", modes.units_);
    read("distance", modes.distance_), read("feed_mode", modes.feed_mode_), read("offset", modes.offset_);
    read("beam", modes.beam_), read("coolant", modes.coolant_);
    read("feed", modes.feed_), read("power", modes.power_), read("obstacle", modes.obstacle_);
    return modes;
}

std::vector<std::string> GrblModes::take_up() const {
    const auto word = [](char letter, double value) { return letter + format_number(value, 3); };
    std::vector<std::string> lines{"M5", "G21", "G90", "G94", word('G', plane_), word('G', offset_)};
    if (moved_) lines.push_back("G0 " + word('X', at_[0]) + " " + word('Y', at_[1]));
    if (coolant_ != 9) lines.push_back(word('M', coolant_));
    if (feed_ > 0) lines.push_back(word('F', feed_));
    for (const double mode : {units_, distance_, feed_mode_}) lines.push_back(word('G', mode));
    // G2 and G3 need arc words: a line that continues in such a mode is refused, not cut wrongly. The beam
    // comes last, because M3 burns at standstill.
    if (motion_ == 1 && feed_mode_ == 94) lines.push_back("G1");
    if (beam_ != 5) lines.push_back(word('M', beam_) + " " + word('S', power_));
    return lines;
}

}  // namespace lamella
