// Beads of filament that fill the contours of a layer: walls, infill, and whatever it takes for thin islands.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/contours.h"

namespace lamella {

/// What a bead is for.
enum class Role : std::uint8_t { external_perimeter, internal_infill, solid_infill, gap_fill, support };

/// A path along which filament is laid, mm.
struct Bead {
    std::vector<dvec2> points;
    double width = 0;  ///< mm, the widest; the cross-section is bead_area(width, height)
    Role role = Role::external_perimeter;
    bool closed = false;           ///< the last point is joined with the first
    int island = 0;                ///< beads of one island follow each other
    std::vector<double> widths{};  ///< at each point, mm, where the width changes; else empty
    double flow = 1;  ///< plastic over what the cross-section takes, for round ends of short beads

    double width_at(std::size_t point) const { return widths.empty() ? width : widths[point]; }
};

/// Plastic that a bead takes in a layer of this height, mm^3.
double bead_volume(const Bead& bead, double height);

struct ToolpathSettings {
    double line_width = 0.45;  ///< mm
    double height = 0.2;       ///< of the layer, mm; at most line_width
    double density = 1;        ///< share of the inside that infill takes, 0 to 1
    double tolerance = 0.025;  ///< by how much paths may leave the contours' offsets, mm
};

struct Toolpaths {
    std::vector<Bead> beads;   ///< in the order of printing
    int islands = 0;           ///< pieces of the layer
    int islands_left_out = 0;  ///< those smaller than a quarter of line_width^2, which get no bead
};

/// Cross-section of a bead, mm^2: a rectangle with round sides, an ellipse when narrower than high.
double bead_area(double width, double height);
/// The width of the bead of this cross-section, mm.
double bead_width(double area, double height);

/// Plans a layer: for each island one wall half a width inside its contours, then straight infill at +45
/// degrees on even and -45 degrees on odd layers. At density 1 the lines are spread evenly over each region,
/// so that the plastic laid has the region's volume.
///
/// Walls of even thickness that one bead fills get one along their middle (see center_lines), up to twice
/// that two side by side. Every other island of at least a quarter of line_width^2 gets a bead, too: where
/// the wall would vanish, narrower ones are tried down to a quarter of the width with the flow that gives the
/// island's volume, and at last a short bead along its longest chord. Thin arms of larger islands are treated
/// alike, down to half the width. No bead is wider than 1.3 line_width.
/// Islands and lines are visited by nearest neighbour from the contours' lower left corner: the result
/// depends on the arguments alone.
Toolpaths plan_toolpaths(const std::vector<Contour>& contours, const ToolpathSettings& settings,
                         int layer_index);

}  // namespace lamella
