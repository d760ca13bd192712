// Direction of the straight beads that bridge an unsupported region.
#pragma once

#include "printers/toolpath/layer_below.h"

namespace lamella {

/// Returns the unit vector along which the fewest lines through an unsupported region have an unsupported
/// end. Among such directions, tried every five degrees, it is the one with the shortest longest span. A line
/// end is supported if there is `footing` a `width` mm beyond it. Lines are spaced a width apart.
dvec2 bridge_direction(const Polygons& hanging, const LayerBelow& footing, double width);

}  // namespace lamella
