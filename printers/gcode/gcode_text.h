// Lines of G-code: moves of a nozzle as text, and what they take in filament.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "printers/gcode/gcode_moves.h"

namespace lamella {

/// What goes into a comment: printable ASCII, and not too much of it.
std::string comment_text(const std::string& text);
/// "1d 2h 3m 4s", as slicers write it.
std::string duration_text(double seconds);

/// Appends lines to a text.
class GcodeText {
  public:
    explicit GcodeText(const PrinterProfile& profile) : profile_(profile) {}

    void line(std::string_view text) { (text_ += text) += '\n'; }
    /// Lines that end in a line feed already.
    void lines(std::string_view text) { text_ += text; }
    /// The moves, which begin at `position`, with changes of the beads' roles and widths announced.
    void moves(std::span<const GcodeMove> moves, dvec2 position, std::span<const Bead> beads = {});

    /// The speed of the fan in this layer, as a share of all, and its least over the void.
    void fan(double layer, double bridges) {
        fan_ = layer;
        bridge_fan_ = std::max(layer, bridges);
    }

    const std::string& text() const { return text_; }
    double filament() const { return filament_; }  ///< extruded, retraction not counted, mm

  private:
    void move(const GcodeMove& move, dvec2 from);
    void announce(const Bead& bead, double bead_width);
    void acceleration(const GcodeMove& move);
    void word(char letter, double value, int decimals);
    void speed(double mm_per_second);

    const PrinterProfile& profile_;
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
