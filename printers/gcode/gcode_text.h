// GcodeText: writes moves as lines of G-code and counts the filament.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "printers/gcode/gcode_moves.h"
#include "printers/gcode/object_labels.h"

namespace lamella {

/// Returns the text reduced to printable ASCII of limited length, for a comment.
std::string comment_text(const std::string& text);
/// Returns a duration as slicers write it, "1d 2h 3m 4s".
std::string duration_text(double seconds);

/// A text of G-code to which lines are appended.
class GcodeText {
  public:
    /// `labels` (may be null) say which part of a plate beads belong to.
    explicit GcodeText(const PrinterProfile& profile, const ObjectLabels* labels = nullptr)
        : profile_(profile), labels_(labels) {}

    void line(std::string_view text) { (text_ += text) += '\n'; }
    /// Appends lines that already end in a line feed.
    void lines(std::string_view text) { text_ += text; }
    /// Appends moves that begin at `position`. Announces changes of the beads' roles and widths.
    void moves(std::span<const GcodeMove> moves, dvec2 position, std::span<const Bead> beads = {});

    /// Sets the speed of the fan in this layer and its lowest speed over bridges, as shares of full speed.
    void fan(double layer, double bridges) {
        fan_ = layer;
        bridge_fan_ = std::max(layer, bridges);
    }

    const std::string& text() const { return text_; }
    double filament() const { return filament_; }  ///< extruded length without retraction, mm

  private:
    void move(const GcodeMove& move, dvec2 from);
    void announce(const Bead& bead, double bead_width);
    void acceleration(const GcodeMove& move);
    void word(char letter, double value, int decimals);
    void speed(double mm_per_second);

    const PrinterProfile& profile_;
    const ObjectLabels* labels_;
    std::string text_;
    double filament_ = 0;
    double speed_ = 0;         // of the last F word, mm/s
    double acceleration_ = 0;  // of the last M204, mm/s^2
    double fan_ = 0, bridge_fan_ = 0;
    bool hangs_ = false;
    std::string role_;
    std::string width_;
};

}  // namespace lamella
