// Primitive shapes. Lengths in mm; sizes must be positive and finite, else the functions throw InputError.
#pragma once

#include "engine/field/field.h"
#include "engine/solids/beam.h"

namespace lamella {

/// Returns the empty solid.
FieldPtr make_empty();
FieldPtr make_sphere(dvec3 center, double radius);
/// Returns a box whose edges are rounded by `rounding` >= 0 (at most half the shortest side).
FieldPtr make_box(const Box& box, double rounding = 0);
/// Returns a cylinder between two points, with flat ends.
FieldPtr make_cylinder(dvec3 a, dvec3 b, double radius);
/// Returns the convex hull of two balls; a capsule when the radii are equal.
FieldPtr make_round_cone(const Beam& beam);
/// Returns a torus around the z direction; minor_radius < major_radius.
FieldPtr make_torus(dvec3 center, double major_radius, double minor_radius);
/// Return a box and a torus that are first rotated or mirrored about the origin by orthogonal `axes`, then
/// moved: closed forms whatever the direction.
FieldPtr make_turned_box(const Box& box, const glm::dmat3& axes, dvec3 at);
FieldPtr make_turned_torus(double major_radius, double minor_radius, const glm::dmat3& axes, dvec3 at);
/// Returns all points p with dot(p, normal) <= offset, where normal is first scaled to unit length.
FieldPtr make_half_space(dvec3 normal, double offset);

}  // namespace lamella
