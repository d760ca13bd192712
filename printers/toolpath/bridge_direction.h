// Along which direction straight beads bridge what has nothing under it.
#pragma once

#include "printers/toolpath/layer_below.h"

namespace lamella {

/// The direction, of unit length, in which the fewest lines through a region that hangs end without a hold,
/// and of such directions, tried every five degrees, the one whose longest span is the shortest. A line is
/// held where there is footing a `width` mm beyond its end; lines lie a width apart.
dvec2 bridge_direction(const Polygons& hanging, const LayerBelow& footing, double width);

}  // namespace lamella
