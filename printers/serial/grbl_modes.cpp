// Interpreter of the words of GRBL.
#include "printers/serial/grbl_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/serial/gcode_line.h"

namespace lamella {
namespace {

// The words of each mode.
constexpr std::array motion_words{0.0, 1.0, 2.0, 3.0};
constexpr std::array plane_words{17.0, 18.0, 19.0};
constexpr std::array beam_words{3.0, 4.0, 5.0};
constexpr std::array coolant_words{7.0, 8.0, 9.0};
constexpr std::array unit_words{20.0, 21.0};
constexpr std::array distance_words{90.0, 91.0};
constexpr std::array feed_words{93.0, 94.0};
constexpr std::array origin_words{54.0, 55.0, 56.0, 57.0, 58.0, 59.0};

bool is_one_of(double value, std::span<const double> values) {
    return std::ranges::find(values, value) != values.end();
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
        std::size_t length = 0;
        const auto value = leading_decimal(command.substr(at), length);
        if (!value) continue;
        at += length;
        take_word(letter, *value);
    }
    return named_[0] || named_[1] ? move() : 0;
}

void GrblModes::take_word(char letter, double value) {
    const double unit = units_ == 20 ? 25.4 : 1;
    if (letter == 'G') {
        constexpr std::array setting{10.0, 28.1, 30.1, 43.1, 92.0};
        constexpr std::array elsewhere{28.0, 30.0, 38.2, 38.3, 38.4, 38.5, 53.0};
        if (is_one_of(value, motion_words)) motion_ = value;
        if (is_one_of(value, plane_words)) plane_ = value;
        if (is_one_of(value, unit_words)) units_ = value;
        if (is_one_of(value, distance_words)) distance_ = value;
        if (is_one_of(value, feed_words)) feed_mode_ = value;
        if (is_one_of(value, origin_words)) offset_ = value;
        if (is_one_of(value, setting)) obstacle_ = "it sets offsets of its own, which a reset may lose";
        if (is_one_of(value, elsewhere))
            obstacle_ = "it moves by the machine's own coordinates or by a probe, which cannot be followed";
    } else if (letter == 'M') {
        if (is_one_of(value, beam_words)) beam_ = value;
        if (is_one_of(value, coolant_words)) coolant_ = value;
        if (value == 2 || value == 30) *this = GrblModes();
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

bool GrblModes::can_be_written() const {
    return std::ranges::all_of(std::array{at_[0], at_[1], feed_, power_},
                               [](double number) { return std::abs(number) <= max_written_number; });
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
    const auto number = [&](const char* name, double& value) { value = written_number(json.at(name)); };
    const auto mode = [&](const char* name, double& value, std::span<const double> known) {
        number(name, value);
        if (!is_one_of(value, known)) throw_not_as_expected();
    };
    number("x", modes.at_[0]), number("y", modes.at_[1]);
    number("feed", modes.feed_), number("power", modes.power_);
    mode("motion", modes.motion_, motion_words), mode("plane", modes.plane_, plane_words);
    mode("units", modes.units_, unit_words), mode("distance", modes.distance_, distance_words);
    mode("feed_mode", modes.feed_mode_, feed_words), mode("offset", modes.offset_, origin_words);
    mode("beam", modes.beam_, beam_words), mode("coolant", modes.coolant_, coolant_words);
    json.at("moved").get_to(modes.moved_);
    json.at("obstacle").get_to(modes.obstacle_);
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
