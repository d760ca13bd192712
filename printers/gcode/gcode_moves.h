// The moves of a nozzle, before they become lines: what each costs, and which are slowed down.
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
    int turn = 0;             ///< of an extrusion: 0 straight, 1 an arc counter-clockwise, -1 clockwise
    bool slowed = false;      ///< below the speed that was asked for
    int bead = -1;            ///< which bead it belongs to; -1: none
    dvec2 to{0};              ///< where x and y are afterwards
    dvec2 center{0};          ///< of an arc
    double z = 0;             ///< of a lift
    double length = 0;        ///< mm of x and y, of z, or of filament
    double filament = 0;      ///< extruded, mm; by a wipe drawn back
    double width = 0;         ///< of the bead that it lays, mm
    double speed = 0;         ///< mm/s
    double acceleration = 0;  ///< mm/s^2
};

/// Collects the moves from one position and height on.
class GcodeMoves {
  public:
    GcodeMoves(const PrinterProfile& profile, dvec2 position, double z)
        : profile_(profile), position_(position), z_(z) {}

    /// Moves straight without extruding; nothing where the nozzle is there.
    void travel(dvec2 to);
    /// Moves up or down to z; nothing where the nozzle is there.
    void lift(double z);
    /// Draws the filament back: along a trail that begins where the nozzle is as much as the speed of
    /// retraction allows, the rest before that.
    void retract(std::span<const dvec2> trail = {});
    void restore();
    /// Extrudes a bead of this cross-section (mm^2) along a piece of path.
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

/// Appends the moves that lay a layer's beads, the first of which begins where the nozzle is, to `moves`.
/// Points are merged where the profile limits the rate of lines, and become arcs where it asks for them; a
/// piece carries the plastic of the points that it stands for. For the ways between beads see BeadTravel.
/// Returns the trail for the retraction that may follow, as long as the profile wipes. Throws Interrupted
/// when `cancel`, which may be null, asks for it.
std::vector<dvec2> add_beads(const Toolpaths& paths, const PrinterProfile& profile, double height,
                             bool first_layer, dvec2 shift, GcodeMoves& moves,
                             const CancelToken* cancel = nullptr);

/// The seconds that each move takes, which begins at `position`.
std::vector<double> seconds_of(std::span<const GcodeMove> moves, dvec2 position, const GcodeProfile& profile);

/// Slows extrusion down, as evenly as the least speed lets it, until the moves take so many seconds.
void slow_to_time(std::vector<GcodeMove>& moves, dvec2 position, const GcodeProfile& profile);

/// Slows moves down until no window of the planner's length has more of them than the machine takes lines in
/// its time; acceleration is left out of account, which only adds time. Shorter windows at the ends get their
/// share of time, so that windows across rows of moves that were slowed one by one hold, too.
/// Returns the mm of extrusion that became slower.
double slow_to_rate(std::vector<GcodeMove>& moves, const GcodeProfile& profile);

}  // namespace lamella
