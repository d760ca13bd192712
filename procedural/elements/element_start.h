// Where elements begin: places sampled by densities, turned along the stress.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/elements/element_raster.h"

namespace lamella {

struct StartSettings {
    std::size_t count = 100;
    Interval scale{1, 1};      ///< limits of their scales; they begin in the middle
    std::uint32_t shapes = 1;  ///< each gets one at random
    bool turns = true;         ///< false: all are as their shapes are given
    std::uint64_t seed = 1;
};

/// Places elements in cells by their densities, as far from each other as so many can be (blue noise), and
/// turns their x axis along the way of the cell, if there are ways, or at random. One density, and one way,
/// by cell. Throws InputError if all densities are 0.
std::vector<PlacedElement> sampled_elements(const CellGrid& grid, std::span<const double> densities,
                                            std::span<const dvec3> ways, const StartSettings& settings);

/// Returns the rotation that takes the x axis to a direction, a unit vector, by the shortest way.
glm::dquat turn_to(dvec3 way);

}  // namespace lamella
