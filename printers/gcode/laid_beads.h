// LaidBeads: the moves that lay a layer's beads, slowed down as the file has them.
#pragma once

#include <vector>

#include "printers/gcode/gcode_moves.h"
#include "printers/gcode/layer_beads.h"

namespace lamella {

/// The moves that lay the beads of one tool, from the first bead on. Positions are on the bed, mm.
struct LaidBeads {
    const ToolBeads* beads = nullptr;
    dvec2 first{0};            ///< start of the first bead
    dvec2 last{0};             ///< end of the last move
    std::vector<dvec2> trail;  ///< path from the end of the last bead along which the nozzle may be wiped
    std::vector<GcodeMove> moves;
    double slowed = 0;  ///< length of extrusion slowed down for the rate of lines, mm
};

/// Returns the shift from the coordinates of a job to those of the bed, mm.
dvec2 bed_shift(const Job& job, const PrinterProfile& profile);

/// Returns the moves of each tool's beads, without those that have none. They are slowed down so that those
/// that are always laid take the layer's least time together. `paths` must outlive the result. Throws
/// Interrupted when the layer's work is cancelled.
std::vector<LaidBeads> lay_beads(const LayerPaths& paths, const Layer& layer, const PrinterProfile& profile,
                                 dvec2 shift);

/// Tells which beads of a layer are laid, in their order: strips of the purge tower depend on whether their
/// tool was changed to.
class LaidChoice {
  public:
    /// `in_use` is the tool before these beads.
    bool takes(int tool, LaidWhen when, int in_use);

  private:
    int tool_ = ToolBeads::any;  // of the last beads
    bool is_changed_ = false;
};

}  // namespace lamella
