// Beads of filament that fill the contours of a layer: walls, infill, and whatever it takes for thin islands.
#pragma once

#include <vector>

#include "engine/base/cancel_token.h"
#include "engine/contours/contours.h"
#include "printers/common/profile.h"
#include "printers/toolpath/bead.h"
#include "printers/toolpath/layer_below.h"

namespace lamella {

struct ToolpathSettings {
    LineSettings line;
    int walls = 1;
    double density = 1;  ///< share of the inside that infill takes, 0 to 1
    InfillPattern infill = InfillPattern::lines;
    Seam seam = Seam::nearest;
};

/// What a layer's paths must know of the layers round it.
struct LayerNeighborhood {
    const LayerBelow* footing = nullptr;   ///< what it rests on; null: the bed
    const PlacedPolygons* core = nullptr;  ///< where layers below and above are solid, so that infill may be
                                           ///< sparse; null: everywhere
};

struct Toolpaths {
    std::vector<Bead> beads;         ///< in the order of printing
    std::vector<Polygons> outlines;  ///< by Bead::island, of those with several beads; within the tolerance
    int islands = 0;                 ///< pieces of the layer
    int islands_left_out = 0;        ///< those smaller than a quarter of line_width^2, which get no bead
};

/// Plans a layer: for each island its walls, the outermost half a width inside its contours, then infill. At
/// density 1 infill has the volume of the region inside the walls, as has every island that is all beads.
///
/// Parts that one bead fills get one along their middle, of changing width (see find_thin_parts). Every other
/// island of at least a quarter of the line's width squared gets a bead, too: where a wall would vanish,
/// narrower ones are tried down to a quarter of the width with the flow that gives the island's volume, and
/// at last a short bead along its longest chord. No bead is wider than 1.5 widths. Islands and lines are
/// visited by nearest neighbour from the contours' lower left corner, and the tour of the islands is
/// shortened (see short_tour): the result depends on the arguments alone.
///
/// Infill over the void runs along the bridge (see bridge_direction), and what hangs of any bead is marked
/// and a bead by itself (see cut_hanging). Throws Interrupted when `cancel`, which may be null, asks for it.
Toolpaths plan_toolpaths(const std::vector<Contour>& contours, const ToolpathSettings& settings,
                         int layer_index, const LayerNeighborhood& around = {},
                         const CancelToken* cancel = nullptr);

}  // namespace lamella
