// Points on a body's surface: cubes that the surface may pass through, and feet of points near it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/field/field.h"

namespace lamella {

/// A point of a surface.
struct SurfaceFoot {
    dvec3 place{0};   ///< mm
    dvec3 normal{0};  ///< of length 1, outward
};

/// The direction in which the body's value rises at p, of length 1, from differences over `step`, mm; null
/// where it has none.
std::optional<dvec3> rising(const Field& body, dvec3 p, double step);

/// The point of the surface under (or above) p, found by following the value's slope, to within `precision`,
/// mm. Null where that leads nowhere. For bodies whose value is a distance near their surface.
std::optional<SurfaceFoot> foot_on_surface(const Field& body, dvec3 p, double precision);

/// A cube of a lattice whose cube (0, 0, 0) begins at the origin.
struct LatticeCube {
    glm::i64vec3 index{0};
    double side = 0;  ///< mm
    Box box() const { return {dvec3(index) * side, dvec3(index + std::int64_t{1}) * side}; }
};

/// Visits cubes that come within `margin` mm of the body's surface, largest first and halved for as long as
/// `divide` says so; a cube that is not divided is visited. The largest are `largest` mm wide; the order is
/// fixed. Throws InputError for a body without an extent or an end.
void walk_surface(const Field& body, double largest, double margin,
                  const std::function<bool(const LatticeCube&)>& divide,
                  const std::function<void(const LatticeCube&)>& visit);

}  // namespace lamella
