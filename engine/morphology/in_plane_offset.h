// In-plane offsets: dilates or erodes the outline of each layer within its plane.
#pragma once

#include <functional>

#include "engine/field/field.h"

namespace lamella {

/// How far the outline is moved in the plane at each height.
struct OutlineOffset {
    std::function<double(double)> at;  ///< from a height to a distance, mm; > 0 grows, < 0 shrinks
    Interval limits;                   ///< encloses all these distances; finite
};

/// The solid with the outline of its section at every height moved by offset.at(z): a section grows by a disc
/// of that radius (convex corners become round), or loses all that a disc of that radius about a point of its
/// border covers (convex corners stay sharp, what is thinner than the disc vanishes). Sections are never
/// mixed, so thin layers and flat roofs stay.
///
/// Discs stand where the lines of a square lattice of pitch `tolerance` (mm, > 0), fixed in the plane, cross
/// the section's border. Straight borders move by the distance asked for less at most tolerance^2 / (4
/// distance); at sharp corners the error is below `tolerance`. What lies between the lines of the lattice is
/// not moved. Sections that are not moved pass through untouched. InputError for a missing solid, limits that
/// are not finite and a tolerance that is not positive.
FieldPtr make_in_plane_offset(FieldPtr solid, OutlineOffset offset, double tolerance);

}  // namespace lamella
