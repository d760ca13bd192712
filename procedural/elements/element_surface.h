// Surfaces of elements' shapes as triangle meshes, for programs that read nothing else.
#pragma once

#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

/// Returns the outline of a stick along x with round ends, counter-clockwise, from chords that deviate by at
/// most `tolerance` mm.
std::vector<dvec2> stick_outline(double length, double width, double tolerance);
/// Returns the two circles of a ring about the origin, `diameter` wide in all, counter-clockwise.
std::vector<std::vector<dvec2>> ring_outline(double diameter, double width, double tolerance);

/// Return closed surfaces of the shapes of make_stick(), make_ring() and make_outline(). Corners lie on the
/// shapes; triangles deviate by at most `tolerance` mm.
TriangleMesh stick_surface(double length, double width, double tolerance);
TriangleMesh ring_surface(double diameter, double width, double tolerance);
/// Throws InputError for polygons whose sides cross or touch.
TriangleMesh outline_surface(const std::vector<std::vector<dvec2>>& polygons, double thickness);

}  // namespace lamella
