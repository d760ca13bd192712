// GridElement: a rectangular finite element of a regular grid, with a node at each corner.
#pragma once

#include <array>

#include "procedural/elasticity/elastic_tensor.h"

namespace lamella {

/// The stiffness of an element. Corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1) times the edges; unknowns
/// are the displacements x, y (and z) of corner 0, of corner 1, and so on.
template <std::size_t Dim>
struct GridElement {
    static constexpr std::size_t corners = std::size_t{1} << Dim;
    static constexpr std::size_t unknowns = Dim * corners;

    std::array<std::array<double, unknowns>, unknowns> stiffness{};
    dvec3 edges{1};  ///< lengths along x, y and z; z is not read in the plane
};

/// Makes a bilinear element in plane stress (quad4), 1 thick. Integration is exact. The stiffness depends on
/// the ratio of the edges alone.
GridElement<2> make_plane_stress_element(const IsotropicMaterial& material, dvec3 edges = dvec3(1));
/// Makes a trilinear element (hex8, see make_hex_element). With edges h times as long it is h times as stiff.
GridElement<3> make_solid_element(const IsotropicMaterial& material, dvec3 edges = dvec3(1));

}  // namespace lamella
