// Bead: an extruded line of filament, its cross-section and its volume.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Purpose of a bead.
enum class Role : std::uint8_t {
    external_perimeter,
    perimeter,
    internal_infill,
    solid_infill,
    gap_fill,
    skirt,
    support,
    purge_tower
};

/// A path along which filament is extruded, mm.
struct Bead {
    std::vector<dvec2> points;
    double width = 0;  ///< largest width, mm; the cross-section is bead_area(width, height)
    Role role = Role::external_perimeter;
    bool closed = false;           ///< the last point is joined to the first
    int island = 0;                ///< index of the island; beads of one island follow each other
    int object = -1;               ///< index of the part on the plate; -1: none
    std::vector<double> widths{};  ///< width at each point, mm, if it varies; otherwise empty
    bool hangs = false;            ///< nothing supports it from below
    double flow = 1;  ///< extruded volume relative to the cross-section times the length; > 1 fills the round
                      ///< ends of short beads

    double width_at(std::size_t point) const { return widths.empty() ? width : widths[point]; }
};

/// Returns the volume of plastic in a bead of a layer of this height, mm^3.
double bead_volume(const Bead& bead, double height);

/// Returns the cross-section of a bead, mm^2: a rectangle with semicircular sides, or an ellipse if it is
/// narrower than high.
double bead_area(double width, double height);
/// Returns the width of a bead with this cross-section, mm.
double bead_width(double area, double height);

/// Returns the width that both semicircular sides together lose against a rectangle, mm.
double side_loss(double height);

/// The nominal line of all beads, and the permitted deviations from it. Lengths in mm.
struct LineSettings {
    double width = 0.45;
    double height = 0.2;       ///< layer height, at most the width
    double tolerance = 0.025;  ///< largest deviation of paths from the contours' offsets

    /// Returns the distance between adjacent beads that fill the plane.
    double spacing() const { return width - side_loss(height); }
    /// Returns the width of a bead that covers `area` mm^2 over `length` mm, limited so that it does not
    /// bulge over the layer.
    double width_for(double area, double length) const {
        return std::min(bead_width(area / length * height, height), width * max_extra_flow);
    }
    /// Returns the largest wall thickness that one bead with maximal extra flow fills.
    double thickest() const { return max_extra_flow * width - side_loss(height); }
    /// Returns the largest wall thickness that one bead fills if its width follows the thickness.
    double thickest_tapered() const { return widest_tapered * width - side_loss(height); }
    /// Returns the area below which a piece gets no bead, mm^2.
    double min_area() const { return width * width / 4; }

    static constexpr double max_extra_flow = 1.3;  ///< more flow would make the bead bulge
    static constexpr double min_flow = 0.7;        ///< less flow would leave gaps
    static constexpr double narrowest = 0.3;       ///< in nominal widths; thinner threads tear
    static constexpr double widest_tapered = 1.5;  ///< in nominal widths; thicker parts get two beads
};

}  // namespace lamella
