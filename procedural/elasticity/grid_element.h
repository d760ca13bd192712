// GridElement: a square or cubic finite element of a regular grid, with a node at each corner.
#pragma once

#include <array>

#include "procedural/elasticity/elastic_tensor.h"

namespace lamella {

/// The stiffness of an element of edge 1. Corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1); unknowns are the
/// displacements x, y (and z) of corner 0, of corner 1, and so on.
template <std::size_t Dim>
struct GridElement {
    static constexpr std::size_t corners = std::size_t{1} << Dim;
    static constexpr std::size_t unknowns = Dim * corners;

    std::array<std::array<double, unknowns>, unknowns> stiffness{};
};

/// Makes a bilinear element in plane stress (quad4), 1 thick. Integration is exact. The stiffness of a square
/// of any edge is the same.
GridElement<2> make_plane_stress_element(const IsotropicMaterial& material);
/// Makes a trilinear element (hex8, see make_hex_element). That of edge h is h times as stiff.
GridElement<3> make_solid_element(const IsotropicMaterial& material);

}  // namespace lamella
