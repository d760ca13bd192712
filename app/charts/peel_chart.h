// A chart of the area that each layer pulls at while it is peeled off, and of the load on what carries it.
#pragma once

#include <string>

#include "engine/checks/print_check.h"
#include "engine/layers/layer_plan.h"

namespace lamella {

/// Returns an SVG element with two curves over the height: the area of each layer, and the load on the
/// section that is stressed most, on a logarithmic axis with a line at `limit`.
std::string peel_chart(const PeelCurve& curve, double limit, const LayerPlan& layers);

}  // namespace lamella
