// Shells of solids, and bodies made of a shell and a filling.
#pragma once

#include "engine/field/field.h"
#include "engine/field/grading.h"

namespace lamella {

/// A field with shells in closed form, beside or instead of its offset. Meshes have them: the union of the
/// balls about all points of their triangles.
class ShellMaker {
  public:
    virtual ~ShellMaker() = default;
    /// Returns a field that, inside the solid, is solid exactly within `thickness` mm of the surface; outside
    /// the solid it may be anything.
    virtual FieldPtr shell(double thickness) const = 0;
    /// Returns a shell whose thickness varies over the surface, mm, >= 0, with a finite range.
    virtual FieldPtr graded_shell(const Grading& thickness) const = 0;
    /// Returns the outer counterpart: outside the solid it is solid exactly within the thickness, inside it
    /// may be anything.
    virtual FieldPtr graded_outer_shell(const Grading& thickness) const = 0;
};

/// Position of a body's skin: under its surface, on it, or half and half.
enum class SkinSide : std::uint8_t { inside, outside, centred };

/// Returns a field that, inside the body, is solid exactly where the surface is at most `thickness` mm away
/// (true 3D distance). Outside the body it may be solid too: intersect it with the body. Throws InputError
/// when the body has neither a closed form of it (ShellMaker, Field::offset) nor an exact metric.
FieldPtr make_shell(const FieldPtr& body, double thickness);

/// Returns a shell whose thickness varies, mm, clamped to limits (0 <= lo <= hi, hi > 0; where the grading is
/// NaN, the upper one). A mesh reads it at its surface: the shell is the union of balls around the surface's
/// points, with the thickness there as radius; triangles are divided until the thickness is linear over them
/// to 2 %, or until they are small against it. Where it is 0 there is no shell. Any other body needs an exact
/// metric, and its thickness is read at the query point. Throws InputError for other bodies.
FieldPtr make_shell(const FieldPtr& body, const GradingPtr& thickness, Interval thickness_limits);

/// Returns the outer counterpart: a field that, outside the body, is solid exactly where the surface is at
/// most `thickness` mm away. Inside the body it may be solid too. Throws InputError when the body has
/// neither a closed-form offset nor an exact metric.
FieldPtr make_outer_shell(const FieldPtr& body, double thickness);

/// Returns the outer counterpart with a varying thickness, read and limited as in make_shell, with the same
/// errors.
FieldPtr make_outer_shell(const FieldPtr& body, const GradingPtr& thickness, Interval thickness_limits);

/// Returns the body's points that are in the filling or within `thickness` mm of its surface. The filling may
/// be null (a hollow body), the thickness 0 (no skin); not both. With a skin outside: the body's points in
/// the filling, and the points outside the body within `thickness` mm of it; with a centred one: half the
/// thickness on either side.
FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, double thickness,
                          SkinSide side = SkinSide::inside);

/// Returns a filled body with a skin of varying thickness; the filling may be null.
FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, const GradingPtr& thickness,
                          Interval thickness_limits, SkinSide side = SkinSide::inside);

}  // namespace lamella
