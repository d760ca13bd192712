// GrblModes: the modal state of GRBL after the lines sent so far, and the commands that restore it.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// Tracks a job of GRBL 1.1 line by line. A line may hold several words, with or without blanks; a line
/// without a G word continues the motion mode of the line before. Lengths in mm, speeds in mm/min.
class GrblModes {
  public:
    /// Applies a clean command (see clean_command). Returns the time of its motion at the programmed speed,
    /// s. Rapid moves count as 0, because their speed is a setting of the machine.
    double apply(std::string_view command);

    /// Returns false if a number is so large that no line can restore it.
    bool can_be_written() const;
    /// Returns why this state cannot be restored; empty if it can. A tool moved in z cannot be set down in
    /// the middle of a cut, and offsets set by the job are lost in a reset.
    const std::string& obstacle() const { return obstacle_; }

    double x() const { return at_[0]; }
    double y() const { return at_[1]; }
    double feed() const { return feed_; }
    int motion() const { return static_cast<int>(motion_); }
    bool inches() const { return units_ == 20; }

    nlohmann::ordered_json to_json() const;
    /// Throws nlohmann::json::exception if a field is missing or none of a machine.
    static GrblModes from_json(const nlohmann::ordered_json& json);

    /// Returns the commands that restore this state on a machine whose origin is unchanged. The beam is off
    /// during the approach.
    std::vector<std::string> take_up() const;

  private:
    void take_word(char letter, double value);
    double move();

    std::array<double, 2> at_{0, 0};  // x, y
    bool moved_ = false;              // at_ is known
    double motion_ = 0;               // G word of the motion mode, 0 to 3
    double plane_ = 17, units_ = 21, distance_ = 90, feed_mode_ = 94, offset_ = 54;
    double beam_ = 5, coolant_ = 9;  // M words
    double feed_ = 0, power_ = 0;
    std::string obstacle_;

    // Words of the line being read.
    std::array<double, 2> way_{0, 0};
    std::array<bool, 2> named_{false, false};
};

}  // namespace lamella
