// From a design on a coarse grid to a start on a grid of half the element's edge.
#pragma once

#include <span>
#include <vector>

#include "procedural/optimization/density_map.h"

namespace lamella {

/// A design of squares in the plane and what its elements are, x fastest.
struct PlaneDesign {
    glm::ivec3 size{0};  ///< z = 1
    std::span<const ElementUse> use;
    std::span<const double> values;
};

/// Returns the size of a grid whose elements are twice as wide, sides rounded up.
glm::ivec3 halved_size(glm::ivec3 size);

/// Returns the design at the centres of a finer grid's elements, half as wide; both grids have the same
/// middle. Bilinear between the centres of the coarse elements that are free, beyond them constant: designs
/// of prescribed elements mean nothing. Elements that are not free get 0, free ones without a free one near
/// by `otherwise`. Throws InputError unless coarse.size is halved_size(size), and for wrong numbers of
/// values.
std::vector<double> upsampled_design(const PlaneDesign& coarse, glm::ivec3 size,
                                     std::span<const ElementUse> use, double otherwise);

}  // namespace lamella
