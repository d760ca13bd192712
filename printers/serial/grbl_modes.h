// GrblModes: the modes of GRBL behind the lines it was sent, and the way back into them.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// Follows a job of GRBL 1.1 line by line: several words may stand in a line, with or without blanks, and a
/// line without a G word moves as the one before. Lengths in mm, speeds in mm/min.
class GrblModes {
  public:
    /// Takes a clean command and returns the seconds its motion takes at the speed asked for; fast moves
    /// count nothing, for their speed is a setting of the machine.
    double apply(std::string_view command);

    /// Why a machine cannot be brought back to this state; empty when it can. A tool that is moved in z
    /// cannot be set down in the midst of a cut, and offsets that the job has set itself are gone with a
    /// reset.
    const std::string& obstacle() const { return obstacle_; }

    nlohmann::ordered_json to_json() const;
    /// Throws nlohmann::json::exception when something is missing.
    static GrblModes from_json(const nlohmann::ordered_json& json);

    /// Lines that bring a machine whose origin is where it was to this state, with the beam off on the way.
    std::vector<std::string> take_up() const;

  private:
    void take_word(char letter, double value);
    double move();

    std::array<double, 2> at_{0, 0};  // x, y
    bool moved_ = false;              // they are known
    double motion_ = 0;               // the G word, 0 to 3
    double plane_ = 17, units_ = 21, distance_ = 90, feed_mode_ = 94, offset_ = 54;
    double beam_ = 5, coolant_ = 9;  // the M words
    double feed_ = 0, power_ = 0;
    std::string obstacle_;

    // Of the line that is read.
    std::array<double, 2> way_{0, 0};
    std::array<bool, 2> named_{false, false};
};

}  // namespace lamella
