// The moves of a nozzle, before they become lines: what each costs, and which are slowed down.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "printers/motion_model.h"
#include "printers/path_fit.h"
#include "printers/profile.h"
#include "printers/toolpath.h"

namespace lamella {

/// One line of G-code that moves something. Positions are on the bed, mm.
struct GcodeMove {
    enum class Kind : std::uint8_t { travel, lift, extrude, retract, restore };
    Kind kind = Kind::travel;
    int turn = 0;             ///< of an extrusion: 0 straight, 1 an arc counter-clockwise, -1 clockwise
    bool slowed = false;      ///< below the speed that was asked for
    int bead = -1;            ///< which bead it belongs to; -1: none
    dvec2 to{0};              ///< where x and y are afterwards
    dvec2 center{0};          ///< of an arc
    double z = 0;             ///< of a lift
    double length = 0;        ///< mm of x and y, of z, or of filament
    double filament = 0;      ///< extruded, mm
    double width = 0;         ///< of the bead that it lays, mm
    double speed = 0;         ///< mm/s
    double acceleration = 0;  ///< mm/s^2
};

/// Collects the moves from one position on.
class GcodeMoves {
  public:
    GcodeMoves(const PrinterProfile& profile, dvec2 position) : profile_(profile), position_(position) {}

    /// Moves without extruding, retracted when `retract` is set and the machine retracts at all.
    void travel(dvec2 to, bool retract);
    /// Moves up or down by `way`, to z.
    void lift(double z, double way);
    void retract();
    void restore();
    /// Extrudes a bead of this cross-section (mm^2) along a piece of path.
    void extrude(const PathPiece& piece, double area, double speed, double acceleration, int bead);

    dvec2 position() const { return position_; }
    bool retracts() const { return profile_.filament.retraction > 0; }
    std::vector<GcodeMove>& moves() { return moves_; }

  private:
    const PrinterProfile& profile_;
    dvec2 position_;
    std::vector<GcodeMove> moves_;
};

/// Appends the moves that lay beads, the first of which begins where the nozzle is, to `moves`. Points are
/// merged where the profile limits the rate of lines, and become arcs where it asks for them; a piece carries
/// the plastic of the points that it stands for.
void add_beads(std::span<const Bead> beads, const PrinterProfile& profile, double height, bool first_layer,
               dvec2 shift, GcodeMoves& moves);

/// The seconds that each move takes, which begins at `position`.
std::vector<double> seconds_of(std::span<const GcodeMove> moves, dvec2 position, const GcodeProfile& profile);

/// Slows extrusion down, as evenly as the least speed lets it, until the moves take so many seconds.
void slow_to_time(std::vector<GcodeMove>& moves, dvec2 position, const GcodeProfile& profile);

/// Slows moves down until no window of the planner's length has more of them than the machine takes lines in
/// its time; acceleration is left out of account, which only adds time. Windows at the ends are shorter.
/// Returns the mm of extrusion that became slower.
double slow_to_rate(std::vector<GcodeMove>& moves, const GcodeProfile& profile);

}  // namespace lamella
