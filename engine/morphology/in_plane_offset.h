// In-plane offsets: dilates or erodes the outline of each layer within its plane.
#pragma once

#include <functional>

#include "engine/field/field.h"

namespace lamella {

/// The distance by which a solid's outline is moved within the plane, as a function of height.
struct OutlineOffset {
    std::function<double(double)> at;  ///< maps a height to a distance, mm; > 0 dilates, < 0 erodes
    Interval limits;                   ///< encloses all distances that `at` returns; finite
};

/// Returns the solid with its section at every height z moved by offset.at(z). A positive distance dilates
/// the section by a disc of that radius: convex corners become round. A negative distance removes all points
/// that a disc of that radius about a point of the section's border covers: convex corners stay sharp, walls
/// thinner than the disc's diameter vanish. Every section is offset by itself, so thin layers and flat roofs
/// survive.
///
/// The discs are centred where the lines of a square lattice of pitch `tolerance` (mm, > 0), fixed in the
/// plane, cross the section's border. A straight border moves by the distance, less at most tolerance^2 / (4
/// distance). At sharp corners the error is below `tolerance`. A border that lies between lattice lines and
/// crosses none does not move. A section whose distance is 0 is passed on unchanged.
///
/// Throws InputError when the solid or the function is missing, the limits are not finite, or the tolerance
/// is not positive and finite.
FieldPtr make_in_plane_offset(FieldPtr solid, OutlineOffset offset, double tolerance);

}  // namespace lamella
