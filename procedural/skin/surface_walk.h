// Points on a body's surface: the projection of nearby points, and an octree walk over cubes near the
// surface.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/field/field.h"

namespace lamella {

/// A point on a surface.
struct SurfaceFoot {
    dvec3 place{0};   ///< mm
    dvec3 normal{0};  ///< unit vector, outward
};

/// Returns the unit gradient of the body's value at p, from differences over `step`, mm; none if the gradient
/// is zero or not finite.
std::optional<dvec3> rising(const Field& body, dvec3 p, double step);

/// Returns the projection of p onto the surface, found by following the gradient of the value, to within
/// `precision`, mm. None if that does not converge. For bodies whose value is a distance near their surface.
std::optional<SurfaceFoot> foot_on_surface(const Field& body, dvec3 p, double precision);

/// A cube of a lattice; cube (0, 0, 0) has its lower corner at the origin.
struct LatticeCube {
    glm::i64vec3 index{0};
    double side = 0;  ///< mm
    Box box() const { return {dvec3(index) * side, dvec3(index + std::int64_t{1}) * side}; }
};

/// Calls `visit` for cubes within `margin` mm of the body's surface. Starts with cubes of side `largest`, mm,
/// and halves each as long as `divide` returns true. The order is fixed. Throws InputError for an empty or
/// unbounded body.
void walk_surface(const Field& body, double largest, double margin,
                  const std::function<bool(const LatticeCube&)>& divide,
                  const std::function<void(const LatticeCube&)>& visit);

}  // namespace lamella
