// MachineState: position, modes and temperatures of a printer after the lines sent so far.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// Tracks G-code line by line. Lengths in mm, speeds in mm/min, temperatures in degrees Celsius.
class MachineState {
  public:
    /// Applies a clean command (see clean_command). Returns the time of its motion at the programmed speed,
    /// s.
    double apply(std::string_view command);

    /// Returns false if a number is so large that no line can restore it.
    bool can_be_written() const;
    /// Returns true once the position of x, y and z is known, by homing or by a move.
    bool located() const { return known_[0] && known_[1] && known_[2]; }
    double x() const { return at_[0]; }
    double y() const { return at_[1]; }
    double z() const { return at_[2]; }
    double e() const { return at_[3]; }
    double feed() const { return feed_; }
    bool relative_extrusion() const { return relative_e_; }
    double nozzle() const { return in_use() < nozzles_.size() ? nozzles_[in_use()] : 0; }
    double bed() const { return bed_; }

    nlohmann::ordered_json to_json() const;
    /// Throws nlohmann::json::exception if a field is missing or none of a machine.
    static MachineState from_json(const nlohmann::ordered_json& json);

    /// Returns the commands that lift the nozzle off the part and park it, and those that return it as it
    /// was.
    std::vector<std::string> leave(double park_x, double park_y, double highest) const;
    std::vector<std::string> come_back(double highest) const;
    /// Returns what `leave` of the state `left` still has to do in this state, which is somewhere on the way
    /// off the part or back to it.
    std::vector<std::string> leave_from(const MachineState& left, double park_x, double park_y,
                                        double highest) const;
    /// Returns the commands that switch off the heaters of all tools and the bed, the fan and, if wanted, the
    /// motors.
    std::vector<std::string> switch_off(bool motors = true) const;
    /// Returns the commands that restore this state on a machine that may have been reset, with the part on
    /// its bed and the nozzle at height `z`. They home X and Y, never Z. `height_line` tells the machine the
    /// height of its nozzle; empty: it knows it.
    std::vector<std::string> take_up(double z, double park_x, double park_y, double highest,
                                     const std::string& height_line) const;

  private:
    /// The tool whose nozzle is heated without a T word, counted from 0.
    std::size_t in_use() const { return tool_ < 0 ? 0 : static_cast<std::size_t>(tool_); }
    void heat(std::size_t tool, double degrees);
    /// Returns the commands that heat all nozzles, without waiting, and select the tool in use.
    std::vector<std::string> tools() const;
    std::vector<std::string> modes() const;
    double lifted(double z, double highest) const;

    double at_[4] = {0, 0, 0, 0};  // x, y, z, e
    bool known_[3] = {false, false, false};
    bool relative_ = false;
    bool relative_e_ = false;
    double feed_ = 0;
    int tool_ = -1;                // in use; -1: none was selected
    std::vector<double> nozzles_;  // by tool
    double bed_ = 0;
    double fan_ = 0;  // 0 to 255
};

}  // namespace lamella
