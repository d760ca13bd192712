// Contours: the closed polygons of a layer, traced from row runs and column runs.
#pragma once

#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// A closed polygon without a repeated last point, mm. Outer contours run counter-clockwise, holes clockwise.
struct Contour {
    std::vector<dvec2> points;
    int parent = -1;    ///< index of the contour that directly encloses this one, -1 when none
    bool hole = false;  ///< true for a clockwise contour that bounds a void
};

/// Traces the contours of a slice: closed, simple, never crossing each other, oriented and nested, within
/// `tolerance` mm of the solid's border. The tolerance determines the lattice pitch (see contour_pitch); a
/// feature that lies entirely inside one lattice cell is missed.
std::vector<Contour> trace_contours(const SliceField& slice, double tolerance, Scratch& scratch);

/// Returns the lattice pitch for a tolerance, mm.
double contour_pitch(double tolerance);

/// Returns the signed area of a polygon, mm^2; positive when counter-clockwise.
double signed_area(const std::vector<dvec2>& points);

}  // namespace lamella
