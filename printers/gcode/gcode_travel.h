// BeadTravel: travel of the nozzle from the end of one bead to the start of the next.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "printers/gcode/gcode_moves.h"
#include "printers/toolpath/inner_travel.h"

namespace lamella {

/// Returns the height at which the nozzle makes a retracted travel of this length, if it starts and ends at
/// height z, mm. Never above the bed's height limit.
double travel_height(const PrinterProfile& profile, double z, double length);

/// Appends the moves from the end of one tool's beads to a place at height `z` over the start of the next
/// ones: retracts, wiping along `trail`, rises and travels.
void leave_beads(GcodeMoves& moves, std::span<const dvec2> trail, double z, dvec2 to);
/// Appends the moves that follow: down to the layer's top, and the filament comes back.
void reach_beads(GcodeMoves& moves, double top);

/// Chooses the path of a travel and whether the filament is retracted. Between beads of one island the path
/// stays inside the island if the profile asks for it and such a path exists; otherwise it is straight.
class BeadTravel {
  public:
    /// `outlines` are those of the beads' islands, before the shift to their place on the bed.
    BeadTravel(const PrinterProfile& profile, std::span<const Polygons> outlines, dvec2 shift,
               GcodeMoves& moves)
        : profile_(profile), outlines_(outlines), shift_(shift), moves_(moves) {}

    /// Appends the moves. `trail` is the path along which the nozzle may be wiped, starting at the nozzle.
    void go(dvec2 to, int from_island, int to_island, std::span<const dvec2> trail);

  private:
    std::optional<std::vector<dvec2>> corners_inside(dvec2 to, int island);
    double length_to(std::span<const dvec2> corners, dvec2 to) const;

    const PrinterProfile& profile_;
    std::span<const Polygons> outlines_;
    dvec2 shift_;
    GcodeMoves& moves_;
    int island_ = -1;  // island that inner_ belongs to
    std::optional<InnerTravel> inner_;
};

}  // namespace lamella
