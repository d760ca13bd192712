// From the end of one bead to the beginning of the next.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "printers/gcode/gcode_moves.h"
#include "printers/toolpath/inner_travel.h"

namespace lamella {

/// The height at which the nozzle travels so far with the filament drawn back, from and to z, mm. It is never
/// above the bed's.
double travel_height(const PrinterProfile& profile, double z, double length);

/// Decides which way the nozzle goes, and whether the filament is drawn back on it: between beads of an
/// island inside it if the profile says so and there is such a way, else straight.
class BeadTravel {
  public:
    /// `outlines` of the beads' islands before they are shifted to their place on the bed.
    BeadTravel(const PrinterProfile& profile, std::span<const Polygons> outlines, dvec2 shift,
               GcodeMoves& moves)
        : profile_(profile), outlines_(outlines), shift_(shift), moves_(moves) {}

    /// Appends the moves. A bead's trail is the way on which the nozzle can be wiped, from where it is.
    void go(dvec2 to, int from_island, int to_island, std::span<const dvec2> trail);

  private:
    std::optional<std::vector<dvec2>> corners_inside(dvec2 to, int island);
    double length_to(std::span<const dvec2> corners, dvec2 to) const;

    const PrinterProfile& profile_;
    std::span<const Polygons> outlines_;
    dvec2 shift_;
    GcodeMoves& moves_;
    int island_ = -1;  // that inner_ is for
    std::optional<InnerTravel> inner_;
};

}  // namespace lamella
