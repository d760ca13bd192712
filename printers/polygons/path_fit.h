// Simplification of polylines within a tolerance: merged points and fitted arcs.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A piece of a path that starts where the piece before ends. Lengths in mm.
struct PathPiece {
    dvec2 to{0};
    dvec2 center{0};    ///< centre of an arc
    int turn = 0;       ///< 0 straight, 1 counter-clockwise arc, -1 clockwise arc
    double length = 0;  ///< length along the piece
    double run = 0;     ///< length along the points that the piece replaces
};

/// Returns the straight pieces between successive points.
std::vector<PathPiece> straight_pieces(std::span<const dvec2> points);

/// Returns straight pieces through fewer points. No omitted point lies farther than `tolerance` from the new
/// path (Douglas and Peucker 1973). No piece returns to its start, unless all of its points are nearer to it
/// than 2 micrometres.
std::vector<PathPiece> merged_pieces(std::span<const dvec2> points, double tolerance);

/// Fits arcs where four or more points lie on one. The search is greedy: from each point the longest arc is
/// taken. The rest are straight pieces, merged if `merge` is set. An arc and the straight path that it
/// replaces lie within `tolerance` of each other. No arc exceeds half a circle. Coordinates of arcs are
/// multiples of `unit`, as they will be written.
std::vector<PathPiece> arc_pieces(std::span<const dvec2> points, double tolerance, bool merge, double unit);

}  // namespace lamella
