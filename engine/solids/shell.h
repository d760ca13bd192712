// The shell of a solid: what lies within a distance of its surface, and solids made of a shell and a filling.
#pragma once

#include "engine/field/field.h"
#include "engine/field/grading.h"

namespace lamella {

/// Where the skin of a body lies: under its surface, on it, or half and half.
enum class SkinSide : std::uint8_t { inside, outside, centred };

/// A field that, inside the body, is solid exactly where the surface is at most `thickness` mm away (true 3D
/// distance). Outside the body it may be solid too: intersect it with the body. InputError for a body without
/// a closed-form offset.
FieldPtr make_shell(const FieldPtr& body, double thickness);

/// A shell whose thickness varies, mm, kept within limits (0 <= lo <= hi, hi > 0; where the grading is NaN,
/// the upper one). A mesh's is read at its surface: about each of its points the ball with the thickness
/// there as radius; triangles are divided until the thickness is linear over them to 2 %, or they are small
/// against it. Where it is 0 there is no shell. Any other body needs a metric that is exact, and its
/// thickness is read at the point in question. InputError for other bodies.
FieldPtr make_shell(const FieldPtr& body, const GradingPtr& thickness, Interval thickness_limits);

/// The other side: a field that, outside the body, is solid exactly where the surface is at most `thickness`
/// mm away. Inside the body it may be solid too. InputError for a body without a closed-form offset.
FieldPtr make_outer_shell(const FieldPtr& body, double thickness);

/// The other side of a shell whose thickness varies; read, limited and refused as there.
FieldPtr make_outer_shell(const FieldPtr& body, const GradingPtr& thickness, Interval thickness_limits);

/// The body filled, under a skin: its part that is in the filling or within `thickness` mm of its surface.
/// The filling may be null (a hollow body), the thickness 0 (no skin); not both. With a skin outside, the
/// body's part that is in the filling, and what lies outside the body within `thickness` mm of it; with a
/// centred one, half the thickness on either side.
FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, double thickness,
                          SkinSide side = SkinSide::inside);

/// The body filled, with a skin of varying thickness; the filling may be null.
FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, const GradingPtr& thickness,
                          Interval thickness_limits, SkinSide side = SkinSide::inside);

}  // namespace lamella
