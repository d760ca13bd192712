// The closed shapes everything is built from. Lengths in mm; sizes must be positive and finite (InputError
// otherwise).
#pragma once

#include "engine/field/field.h"
#include "engine/solids/beam.h"

namespace lamella {

/// Nothing: void everywhere.
FieldPtr make_empty();
FieldPtr make_sphere(dvec3 center, double radius);
/// A box whose edges are rounded by `rounding` >= 0 (at most half the shortest side).
FieldPtr make_box(const Box& box, double rounding = 0);
/// A cylinder between two points, with flat ends.
FieldPtr make_cylinder(dvec3 a, dvec3 b, double radius);
/// The convex hull of two balls; a capsule when the radii are equal.
FieldPtr make_round_cone(const Beam& beam);
/// A torus about the z direction; minor_radius < major_radius.
FieldPtr make_torus(dvec3 center, double major_radius, double minor_radius);
/// All points p with dot(p, normal) <= offset, for a unit normal (it is normalised here).
FieldPtr make_half_space(dvec3 normal, double offset);

}  // namespace lamella
