// HexElement: a trilinear finite element (hex8), a cuboid with a node at each corner.
#pragma once

#include <array>

#include "engine/base/geometry.h"
#include "procedural/elasticity/elastic_tensor.h"

namespace lamella {

inline constexpr int hex_nodes = 8;                 ///< node c lies at (c & 1, c >> 1 & 1, c >> 2 & 1)
inline constexpr int hex_unknowns = 3 * hex_nodes;  ///< displacements x, y, z of node 0, of node 1, ...

struct HexElement {
    std::array<std::array<double, hex_unknowns>, hex_unknowns> stiffness{};
    /// Nodal forces of the uniform stress of each of the six unit strains in Voigt notation.
    std::array<std::array<double, 6>, hex_unknowns> loads{};
};

/// Makes an element of a material with this stiffness, with edges along x, y and z. Integration is exact (two
/// Gauss points per direction).
HexElement make_hex_element(const ElasticTensor& stiffness, dvec3 edges = dvec3(1));

}  // namespace lamella
