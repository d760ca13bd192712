// A bead of filament.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// What a bead is for.
enum class Role : std::uint8_t {
    external_perimeter,
    perimeter,
    internal_infill,
    solid_infill,
    gap_fill,
    skirt,
    support
};

/// A path along which filament is laid, mm.
struct Bead {
    std::vector<dvec2> points;
    double width = 0;  ///< mm, the widest; the cross-section is bead_area(width, height)
    Role role = Role::external_perimeter;
    bool closed = false;           ///< the last point is joined with the first
    int island = 0;                ///< beads of one island follow each other
    std::vector<double> widths{};  ///< at each point, mm, where the width changes; else empty
    bool hangs = false;            ///< there is nothing under it
    double flow = 1;  ///< plastic over what the cross-section takes, for round ends of short beads

    double width_at(std::size_t point) const { return widths.empty() ? width : widths[point]; }
};

/// Plastic that a bead takes in a layer of this height, mm^3.
double bead_volume(const Bead& bead, double height);

/// Cross-section of a bead, mm^2: a rectangle with round sides, an ellipse when narrower than high.
double bead_area(double width, double height);
/// The width of the bead of this cross-section, mm.
double bead_width(double area, double height);

/// What a height's two round sides take from a bead's width together, mm.
double side_loss(double height);

/// The line that all beads are made of, and how far they may differ from it. Lengths in mm.
struct LineSettings {
    double width = 0.45;
    double height = 0.2;       ///< of the layer, at most width
    double tolerance = 0.025;  ///< by how much paths may leave the contours' offsets

    /// From bead to bead when they fill the plane.
    double spacing() const { return width - side_loss(height); }
    /// The width of a bead that lays `area` mm^2 over `length`, as far as it does not bulge over the layer.
    double width_for(double area, double length) const {
        return std::min(bead_width(area / length * height, height), width * max_extra_flow);
    }
    /// Thickness of a wall that one bead with all its extra flow fills.
    double thickest() const { return max_extra_flow * width - side_loss(height); }
    /// The same where the bead's width follows the wall's thickness.
    double thickest_tapered() const { return widest_tapered * width - side_loss(height); }
    /// Smaller pieces get no bead, mm^2.
    double min_area() const { return width * width / 4; }

    static constexpr double max_extra_flow = 1.3;  ///< more would bulge
    static constexpr double min_flow = 0.7;        ///< less would leave gaps
    static constexpr double narrowest = 0.3;       ///< thinner threads, in widths, tear
    static constexpr double widest_tapered = 1.5;  ///< in widths; thicker parts take two beads
};

}  // namespace lamella
