// Tracks moves, modes and temperatures.
#include "printers/serial/machine_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/serial/gcode_line.h"

namespace lamella {
namespace {

constexpr double lift = 5;          // mm; height of a parked nozzle above the part
constexpr double retraction = 2;    // mm; prevents oozing while parked
constexpr double prime = 8;         // mm of filament that refill a nozzle which has stood cold
constexpr double min_nozzle = 150;  // degrees Celsius; below it nothing is extruded
constexpr std::size_t most_tools = 100;

std::string number(double value, int decimals = 3) { return format_number(value, decimals); }

/// Returns the tool that a command such as T1 selects.
std::optional<std::size_t> selected_tool(std::string_view name) {
    if (name.size() < 2 || name.size() > 3 || name[0] != 'T') return std::nullopt;
    std::size_t tool = 0;
    for (const char c : name.substr(1)) {
        if (c < '0' || c > '9') return std::nullopt;
        tool = 10 * tool + static_cast<std::size_t>(c - '0');
    }
    return tool;
}

}  // namespace

double MachineState::apply(std::string_view command) {
    const std::string name = command_word(command);
    constexpr char letters[] = {'X', 'Y', 'Z', 'E'};
    if (name == "G0" || name == "G1" || name == "G2" || name == "G3") {
        double way = 0, pushed = 0;
        for (int axis = 0; axis < 4; ++axis) {
            const auto value = command_value(command, letters[axis]);
            if (!value) continue;
            const bool relative = axis == 3 ? relative_e_ : relative_;
            const double to = relative ? at_[axis] + *value : *value;
            const double step = to - at_[axis];
            (axis == 3 ? pushed : way) += step * step;
            at_[axis] = to;
            if (axis < 3 && !relative) known_[axis] = true;
        }
        if (const auto feed = command_value(command, 'F')) feed_ = *feed;
        return feed_ > 0 ? std::sqrt(way > 0 ? way : pushed) / feed_ * 60 : 0;
    }
    if (name == "G4")
        return command_value(command, 'S').value_or(command_value(command, 'P').value_or(0) / 1000);
    if (name == "G28") {
        const bool all = command.find_first_of("XYZ") == std::string_view::npos;
        for (int axis = 0; axis < 3; ++axis) {
            if (!all && command.find(letters[axis]) == std::string_view::npos) continue;
            at_[axis] = 0;
            known_[axis] = true;
        }
    } else if (name == "G90" || name == "G91") {
        relative_ = name == "G91";
        relative_e_ = relative_;
    } else if (name == "M82" || name == "M83") {
        relative_e_ = name == "M83";
    } else if (name == "G92") {
        for (int axis = 0; axis < 4; ++axis) {
            if (const auto value = command_value(command, letters[axis])) at_[axis] = *value;
        }
    } else if (name == "M104" || name == "M109") {
        const double tool = command_value(command, 'T').value_or(static_cast<double>(in_use()));
        const auto degrees =
            command_value(command, 'S').value_or(command_value(command, 'R').value_or(nozzle()));
        if (tool >= 0 && tool < static_cast<double>(most_tools))
            heat(static_cast<std::size_t>(tool), degrees);
    } else if (const auto tool = selected_tool(name)) {
        tool_ = static_cast<int>(*tool);
    } else if (name == "M140" || name == "M190") {
        bed_ = command_value(command, 'S').value_or(command_value(command, 'R').value_or(bed_));
    } else if (name == "M106") {
        fan_ = command_value(command, 'S').value_or(255);
    } else if (name == "M107") {
        fan_ = 0;
    }
    return 0;
}

void MachineState::heat(std::size_t tool, double degrees) {
    if (nozzles_.size() <= tool) nozzles_.resize(tool + 1, 0);
    nozzles_[tool] = degrees;
}

bool MachineState::can_be_written() const {
    const auto can = [](double number) { return std::abs(number) <= max_written_number; };
    return std::ranges::all_of(std::array{at_[0], at_[1], at_[2], at_[3], feed_, bed_, fan_}, can) &&
           std::ranges::all_of(nozzles_, can);
}

nlohmann::ordered_json MachineState::to_json() const {
    return {
        {"x", at_[0]},          {"y", at_[1]},           {"z", at_[2]},   {"e", at_[3]},
        {"located", located()}, {"relative", relative_}, {"feed", feed_}, {"relative_extrusion", relative_e_},
        {"tool", tool_},        {"nozzles", nozzles_},   {"bed", bed_},   {"fan", fan_}};
}

MachineState MachineState::from_json(const nlohmann::ordered_json& json) {
    MachineState state;
    constexpr const char* names[] = {"x", "y", "z", "e"};
    for (int axis = 0; axis < 4; ++axis) state.at_[axis] = written_number(json.at(names[axis]));
    for (bool& known : state.known_) known = json.at("located").get<bool>();
    state.relative_ = json.at("relative").get<bool>();
    state.relative_e_ = json.at("relative_extrusion").get<bool>();
    state.feed_ = written_number(json.at("feed"));
    // A number that no command selects is refused as one of another type is.
    if (const auto& tool = json.at("tool"); whole_number<std::int8_t>(tool) >= 0)
        state.tool_ = whole_number<std::uint8_t>(tool);
    for (const auto& degrees : json.at("nozzles")) state.heat(state.nozzles_.size(), written_number(degrees));
    state.bed_ = written_number(json.at("bed"));
    state.fan_ = written_number(json.at("fan"));
    return state;
}

double MachineState::lifted(double z, double highest) const {
    return std::max(z, std::min(z + lift, highest));
}

std::vector<std::string> MachineState::tools() const {
    std::vector<std::string> lines;
    if (tool_ < 0) return lines;
    for (std::size_t tool = 0; tool < nozzles_.size(); ++tool) {
        if (tool != in_use() && nozzles_[tool] > 0)
            lines.push_back("M104 T" + std::to_string(tool) + " S" + number(nozzles_[tool]));
    }
    lines.push_back("T" + std::to_string(tool_));
    return lines;
}

std::vector<std::string> MachineState::modes() const {
    std::vector<std::string> lines;
    lines.emplace_back(relative_ ? "G91" : "G90");
    lines.emplace_back(relative_e_ ? "M83" : "M82");
    if (!relative_e_) lines.push_back("G92 E" + number(at_[3], 5));
    if (feed_ > 0) lines.push_back("G1 F" + number(feed_));
    return lines;
}

std::vector<std::string> MachineState::leave(double park_x, double park_y, double highest) const {
    std::vector<std::string> lines{"G90", "M83"};
    if (nozzle() >= min_nozzle) lines.push_back("G1 E" + number(-retraction) + " F1800");
    if (!located()) return lines;
    lines.push_back("G0 Z" + number(lifted(at_[2], highest)) + " F600");
    lines.push_back("G0 X" + number(park_x) + " Y" + number(park_y) + " F6000");
    return lines;
}

std::vector<std::string> MachineState::leave_from(const MachineState& left, double park_x, double park_y,
                                                  double highest) const {
    constexpr double slack = 1e-6;
    std::vector<std::string> lines{"G90", "M83"};
    const double drawn_back = left.at_[3] - at_[3];
    if (left.nozzle() >= min_nozzle && drawn_back < retraction - slack)
        lines.push_back("G1 E" + number(drawn_back - retraction) + " F1800");
    if (!located()) return lines;
    if (const double up = left.lifted(left.at_[2], highest); at_[2] < up - slack)
        lines.push_back("G0 Z" + number(up) + " F600");
    lines.push_back("G0 X" + number(park_x) + " Y" + number(park_y) + " F6000");
    return lines;
}

std::vector<std::string> MachineState::come_back(double highest) const {
    std::vector<std::string> lines{"G90", "M83"};
    if (bed_ > 0) lines.push_back("M190 S" + number(bed_));
    if (nozzle() > 0) lines.push_back("M109 S" + number(nozzle()));
    if (located()) {
        lines.push_back("G0 Z" + number(lifted(at_[2], highest)) + " F600");
        lines.push_back("G0 X" + number(at_[0]) + " Y" + number(at_[1]) + " F6000");
        lines.push_back("G0 Z" + number(at_[2]) + " F600");
    }
    if (nozzle() >= min_nozzle) lines.push_back("G1 E" + number(retraction) + " F1800");
    for (std::string& line : modes()) lines.push_back(std::move(line));
    return lines;
}

std::vector<std::string> MachineState::switch_off(bool motors) const {
    std::vector<std::string> lines;
    for (std::size_t tool = 0; tool < nozzles_.size(); ++tool) {
        if (tool != in_use() && nozzles_[tool] > 0) lines.push_back("M104 T" + std::to_string(tool) + " S0");
    }
    lines.insert(lines.end(), {"M104 S0", "M140 S0", "M107"});
    if (motors) lines.emplace_back("M84");
    return lines;
}

std::vector<std::string> MachineState::take_up(double z, double park_x, double park_y, double highest,
                                               const std::string& height_line) const {
    const double up = lifted(z, highest);
    std::vector<std::string> lines{"G21", "G90", "M83"};
    if (bed_ > 0) lines.push_back("M140 S" + number(bed_));
    if (tool_ < 0 && nozzle() > 0) lines.push_back("M104 S" + number(nozzle()));
    if (!height_line.empty()) lines.push_back(height_line);
    lines.push_back("G0 Z" + number(up) + " F600");
    lines.emplace_back("G28 X Y");
    lines.push_back("G0 X" + number(park_x) + " Y" + number(park_y) + " F6000");
    if (bed_ > 0) lines.push_back("M190 S" + number(bed_));
    for (std::string& line : tools()) lines.push_back(std::move(line));
    if (nozzle() > 0) lines.push_back("M109 S" + number(nozzle()));
    if (nozzle() >= min_nozzle) {
        lines.push_back("G1 E" + number(prime) + " F120");
        lines.push_back("G1 E" + number(-retraction) + " F1800");
    }
    lines.push_back("G0 X" + number(at_[0]) + " Y" + number(at_[1]) + " F6000");
    lines.push_back("G0 Z" + number(at_[2]) + " F600");
    if (nozzle() >= min_nozzle) lines.push_back("G1 E" + number(retraction) + " F1800");
    lines.push_back(fan_ > 0 ? "M106 S" + number(fan_) : "M107");
    for (std::string& line : modes()) lines.push_back(std::move(line));
    return lines;
}

}  // namespace lamella
