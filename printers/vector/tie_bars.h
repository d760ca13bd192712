// Tie bars that hold the loose pieces of a layer together.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// Returns a bar for each edge of the minimum spanning tree of the pieces (Prim 1957). Distances are measured
/// between points half a width apart along the outlines. Each bar is `width` mm wide, runs from outline to
/// outline and extends a quarter of its width into both pieces. United with the pieces, the bars form one
/// piece.
Polygons tie_bars(const std::vector<Polygons>& pieces, double width);

}  // namespace lamella
