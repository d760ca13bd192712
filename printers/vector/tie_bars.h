// Bars that hold the loose pieces of a layer together.
#pragma once

#include <vector>

#include "printers/polygons/polygons.h"

namespace lamella {

/// A bar for each pair of neighbours in the tree that joins all pieces at the least total distance (Prim
/// 1957), over points half a width apart along the outlines; each bar, `width` mm wide, runs from
/// outline to outline and a quarter of its width into either piece. With the pieces united they make one
/// piece.
Polygons tie_bars(const std::vector<Polygons>& pieces, double width);

}  // namespace lamella
