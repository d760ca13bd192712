// Fewer pieces for a polyline: points merged, and arcs, within a tolerance.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A piece of a path from where the one before ends. Lengths in mm.
struct PathPiece {
    dvec2 to{0};
    dvec2 center{0};    ///< of an arc
    int turn = 0;       ///< 0 straight, 1 an arc counter-clockwise, -1 clockwise
    double length = 0;  ///< along the piece
    double run = 0;     ///< along the points that the piece stands for
};

/// The pieces between points, one after the other.
std::vector<PathPiece> straight_pieces(std::span<const dvec2> points);

/// The same with fewer points: none that is left out lies farther than `tolerance` from the new path (Douglas
/// and Peucker 1973).
std::vector<PathPiece> merged_pieces(std::span<const dvec2> points, double tolerance);

/// Arcs wherever four or more points lie on one, as far as it goes from each place on (greedy); straight
/// pieces elsewhere, merged if `merge` is set. Arc and points lie within `tolerance` of each other, points of
/// the path's straight stretches included. No arc is more than half a circle. Coordinates of arcs are
/// multiples of `unit`, as they will be written.
std::vector<PathPiece> arc_pieces(std::span<const dvec2> points, double tolerance, bool merge, double unit);

}  // namespace lamella
