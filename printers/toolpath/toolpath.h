// Toolpath planning: beads that fill the contours of a layer: walls, infill, and beads for thin islands.
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
    double density = 1;  ///< share of the interior that infill fills, 0 to 1
    InfillPattern infill = InfillPattern::lines;
    Seam seam = Seam::nearest;
    double retract_from = 2;  ///< travels between islands longer than this retract, mm: few do
};

/// Adjacent layers, as far as a layer's paths depend on them.
struct LayerNeighborhood {
    const LayerBelow* footing = nullptr;   ///< the layer below; null: the bed
    const PlacedPolygons* core = nullptr;  ///< where the layers below and above are solid, so that infill may
                                           ///< be sparse; null: everywhere
};

struct Toolpaths {
    std::vector<Bead> beads;         ///< in printing order
    std::vector<Polygons> outlines;  ///< of islands with several beads, by Bead::island; within tolerance
    int islands = 0;                 ///< number of pieces of the layer
    int islands_left_out = 0;        ///< islands smaller than a quarter of line_width^2: no bead
};

/// Plans the beads of a layer. Each island gets its walls, the outermost half a width inside its contours,
/// then infill. At density 1 infill has the volume of the region inside the walls, and the beads of
/// every island without sparse infill have the island's volume.
///
/// Parts that one bead fills get one along their middle, of varying width (see find_thin_parts). Every other
/// island of at least a quarter of the line width squared also gets a bead. Where a wall would vanish,
/// narrower walls are tried, down to a quarter of the width, with the flow that gives the island's volume,
/// and finally a short bead along its longest chord. No bead is wider than 1.5 widths. Islands and lines are
/// visited by nearest neighbour from the contours' lower left corner, and the tour of the islands is
/// shortened (see island_tour), so that few travels are long enough to retract; the last bead of an island
/// ends near the next one. The result depends on the arguments alone.
///
/// Unsupported infill runs along the bridge (see bridge_direction). The unsupported part of any bead is
/// marked and becomes a bead by itself (see cut_hanging). Throws Interrupted when `cancel` (which may be
/// null) requests it.
Toolpaths plan_toolpaths(const std::vector<Contour>& contours, const ToolpathSettings& settings,
                         int layer_index, const LayerNeighborhood& around = {},
                         const CancelToken* cancel = nullptr);

}  // namespace lamella
