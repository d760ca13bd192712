// GcodeMove: moves of a nozzle before they become lines of G-code: durations and slow-down.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "printers/common/profile.h"
#include "printers/gcode/motion_model.h"
#include "printers/polygons/path_fit.h"
#include "printers/toolpath/toolpath.h"

namespace lamella {

/// One line of G-code that moves something. Positions are on the bed, mm.
struct GcodeMove {
    enum class Kind : std::uint8_t { travel, lift, extrude, retract, wipe, restore };
    Kind kind = Kind::travel;
    int turn = 0;             ///< of an extrusion: 0 straight, 1 counter-clockwise arc, -1 clockwise arc
    bool slowed = false;      ///< slower than the requested speed
    int bead = -1;            ///< index of the bead; -1: none
    dvec2 to{0};              ///< x and y at the end of the move
    dvec2 center{0};          ///< centre of an arc
    double z = 0;             ///< z at the end of a lift
    double length = 0;        ///< length in x and y, in z, or of filament, mm
    double filament = 0;      ///< extruded length, mm; of a wipe: retracted length
    double width = 0;         ///< width of the bead, mm
    double speed = 0;         ///< mm/s
    double acceleration = 0;  ///< mm/s^2
};

/// Builds a sequence of moves that begins at a position and height.
class GcodeMoves {
  public:
    GcodeMoves(const PrinterProfile& profile, dvec2 position, double z)
        : profile_(profile), position_(position), z_(z) {}

    /// Moves straight without extruding; adds nothing if the nozzle is already there.
    void travel(dvec2 to);
    /// Moves up or down to z; adds nothing if the nozzle is already there.
    void lift(double z);
    /// Retracts the filament. Along `trail`, which begins at the nozzle, it retracts as much as the
    /// retraction speed allows, and the rest before that.
    void retract(std::span<const dvec2> trail = {});
    void restore();
    /// Extrudes a bead of this cross-section (mm^2) along a piece of a path.
    void extrude(const PathPiece& piece, double area, double speed, double acceleration, int bead);

    dvec2 position() const { return position_; }
    double z() const { return z_; }
    bool retracts() const { return profile_.filament.retraction > 0; }
    std::vector<GcodeMove>& moves() { return moves_; }

  private:
    void add_extruder_move(GcodeMove::Kind kind, double length);

    const PrinterProfile& profile_;
    dvec2 position_;
    double z_;
    std::vector<GcodeMove> moves_;
};

/// Appends the moves that lay a layer's beads to `moves`. The first bead begins at the nozzle. Points are
/// merged if the profile limits the rate of lines, and become arcs if the profile asks for them; a piece
/// carries the plastic of all points that it replaces. For travel between beads see BeadTravel. Returns the
/// trail along which a following retraction may wipe, as long as the profile's wipe. Throws Interrupted when
/// `cancel` (which may be null) requests it.
std::vector<dvec2> add_beads(const Toolpaths& paths, const PrinterProfile& profile, double height,
                             bool first_layer, dvec2 shift, GcodeMoves& moves,
                             const CancelToken* cancel = nullptr);

/// Returns the duration of each move, s. The first move begins at `position`.
std::vector<double> seconds_of(std::span<const GcodeMove> moves, dvec2 position, const GcodeProfile& profile);

/// Slows extrusion down, as evenly as the lowest speed allows, until the moves take this time together, s.
void slow_to_time(std::vector<GcodeMove>& moves, dvec2 position, const GcodeProfile& profile, double least);

/// Slows moves down until no window of `profile.planner_blocks` consecutive moves exceeds the machine's rate
/// of lines. Acceleration is ignored; it only adds time. Shorter windows at both ends get a proportional
/// share of time, so that the limit also holds across sequences that were slowed separately. Returns the
/// length of extrusion that was slowed, mm.
double slow_to_rate(std::vector<GcodeMove>& moves, const GcodeProfile& profile);

}  // namespace lamella
