// Divides a layer's section among the tools that make it.
#pragma once

#include <span>
#include <vector>

#include "engine/contours/contours.h"
#include "engine/layers/layer.h"

namespace lamella {

/// What one tool makes of a layer's section.
struct ToolSection {
    int tool = 0;
    std::vector<Contour> contours;
};

/// Returns the section's shares by tool, in the order of their numbers, without empty ones. `z` is the
/// section's height, `tolerance` that of the zones' contours, mm. Neighbouring shares have one border. Pieces
/// whose mean thickness is below `thinnest` mm are left out: zones and part may have nearly the same surface.
std::vector<ToolSection> divide_by_tool(const std::vector<Contour>& section, std::span<const ToolZone> zones,
                                        double z, double tolerance, double thinnest);

}  // namespace lamella
