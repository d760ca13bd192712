// The elements around loads: solid, since a load needs material to act on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "recipe/structure/structural_problem.h"

namespace lamella {

/// Flags the elements of a grid whose centres are at most `radius` elements from that of a flagged one.
std::vector<std::uint8_t> elements_near(glm::ivec3 size, std::span<const std::uint8_t> flags, double radius);

/// Makes free elements within `radius` elements of those that a load touches solid, in the domain and in the
/// problem. Where nothing is solid, a load would pull at void, and the compliance of the shape meant nothing.
template <std::size_t Dim>
void make_loads_solid(double radius, ElementDomain& domain, StructuralProblem<Dim>& problem);

}  // namespace lamella
