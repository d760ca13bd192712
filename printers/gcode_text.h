// Lines of G-code: moves of a nozzle, and what they take in filament and time.
#pragma once

#include <string>

#include "printers/profile.h"
#include "printers/toolpath.h"

namespace lamella {

/// What moves used up.
struct GcodeUse {
    double filament = 0;  ///< mm, retraction not counted
    double seconds = 0;   ///< at the speeds asked for, acceleration not counted
};

/// Appends moves to a text. Positions are on the bed, mm.
class GcodeText {
  public:
    explicit GcodeText(const FilamentProfile& profile) : profile_(profile) {}

    void line(std::string_view text) { (text_ += text) += '\n'; }
    /// Moves without extruding, retracted when `retract` is set.
    void travel(dvec2 to, bool retract);
    void travel_z(double z);
    /// Extrudes along a straight line a bead of this cross-section (mm^2), at this speed (mm/s).
    void extrude(dvec2 to, double area, double speed);
    /// Where the nozzle is taken to be, without a line.
    void start_at(dvec2 position) { position_ = position; }

    dvec2 position() const { return position_; }
    const GcodeUse& use() const { return use_; }
    const std::string& text() const { return text_; }
    bool retracts() const { return profile_.retraction > 0; }
    void retract(bool forward);

  private:
    void word(char letter, double value, int decimals);
    void speed(double mm_per_second);

    const FilamentProfile& profile_;
    std::string text_;
    dvec2 position_{0};
    double speed_ = 0;  // of the last F word, mm/s
    GcodeUse use_;
};

/// Throws InputError for the first value of a profile that no printer could work with; height is that of a
/// layer, mm.
void check_filament_profile(const FilamentProfile& profile, double height);
/// The same for the speed of printing supports.
void check_support_speed(const SupportProfile& profile);

}  // namespace lamella
