// Gauss quadrature of B^T C B and B^T C.
#include "procedural/elasticity/hex_element.h"

#include <cmath>

namespace lamella {
namespace {

using StrainRows = std::array<std::array<double, hex_unknowns>, 6>;

/// Returns the strain-displacement matrix B at a point, in shares of the edges: strains from nodal
/// displacements.
StrainRows strain_rows(dvec3 p, dvec3 edges) {
    StrainRows b{};
    for (std::size_t c = 0; c < hex_nodes; ++c) {
        const dvec3 side(c & 1, c >> 1 & 1, c >> 2 & 1), weight = side * p + (1.0 - side) * (1.0 - p),
                                                         slope = (2.0 * side - 1.0) / edges;
        const dvec3 d(slope.x * weight.y * weight.z, weight.x * slope.y * weight.z,
                      weight.x * weight.y * slope.z);
        const std::size_t x = 3 * c, y = x + 1, z = x + 2;
        b[0][x] = d.x;
        b[1][y] = d.y;
        b[2][z] = d.z;
        b[3][x] = d.y;
        b[3][y] = d.x;
        b[4][y] = d.z;
        b[4][z] = d.y;
        b[5][z] = d.x;
        b[5][x] = d.z;
    }
    return b;
}

}  // namespace

HexElement make_hex_element(const ElasticTensor& c, dvec3 edges) {
    const std::array<double, 2> points{0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
    const double volume = edges.x * edges.y * edges.z;
    HexElement element;
    for (std::size_t g = 0; g < 8; ++g) {
        const StrainRows b = strain_rows({points[g & 1], points[g >> 1 & 1], points[g >> 2 & 1]}, edges);
        std::array<std::array<double, 6>, hex_unknowns> stress{};  // b^T c
        for (std::size_t u = 0; u < hex_unknowns; ++u) {
            for (std::size_t i = 0; i < 6; ++i) {
                for (std::size_t j = 0; j < 6; ++j) stress[u][j] += b[i][u] * c[i][j];
            }
        }
        for (std::size_t u = 0; u < hex_unknowns; ++u) {
            for (std::size_t j = 0; j < 6; ++j) {
                element.loads[u][j] += stress[u][j] / 8 * volume;
                for (std::size_t v = 0; v < hex_unknowns; ++v)
                    element.stiffness[u][v] += stress[u][j] * b[j][v] / 8 * volume;
            }
        }
    }
    return element;
}

}  // namespace lamella
