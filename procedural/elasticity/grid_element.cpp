// Integrates the stiffness of elements with two Gauss points per direction.
#include "procedural/elasticity/grid_element.h"

#include <cmath>

#include "procedural/elasticity/hex_element.h"

namespace lamella {

namespace {

constexpr std::size_t quad_unknowns = GridElement<2>::unknowns;

/// Rows: strains xx, yy, xy (engineering) per unknown.
using PlaneStrains = std::array<std::array<double, quad_unknowns>, 3>;

/// Returns the strain-displacement matrix at a point, in shares of the edges.
PlaneStrains strains_at(double x, double y, dvec3 edges) {
    PlaneStrains b{};
    for (std::size_t c = 0; c < 4; ++c) {
        const bool right = (c & 1) != 0, top = (c >> 1) != 0;
        const double dx = (right ? 1 : -1) * (top ? y : 1 - y) / edges.x;
        const double dy = (top ? 1 : -1) * (right ? x : 1 - x) / edges.y;
        b[0][2 * c] = dx;
        b[1][2 * c + 1] = dy;
        b[2][2 * c] = dy;
        b[2][2 * c + 1] = dx;
    }
    return b;
}

}  // namespace

GridElement<2> make_plane_stress_element(const IsotropicMaterial& material, dvec3 edges) {
    const double nu = material.poisson, factor = material.young / (1 - nu * nu);
    const std::array<std::array<double, 3>, 3> stress{
        {{factor, factor * nu, 0}, {factor * nu, factor, 0}, {0, 0, factor * (1 - nu) / 2}}};
    const std::array<double, 2> points{0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
    GridElement<2> element;
    element.edges = edges;
    for (std::size_t g = 0; g < 4; ++g) {
        const PlaneStrains b = strains_at(points[g & 1], points[g >> 1], edges);
        for (std::size_t u = 0; u < quad_unknowns; ++u) {
            for (std::size_t v = 0; v < quad_unknowns; ++v) {
                for (std::size_t i = 0; i < 3; ++i) {
                    for (std::size_t j = 0; j < 3; ++j)
                        element.stiffness[u][v] += b[i][u] * stress[i][j] * b[j][v] / 4 * edges.x * edges.y;
                }
            }
        }
    }
    return element;
}

GridElement<3> make_solid_element(const IsotropicMaterial& material, dvec3 edges) {
    GridElement<3> element;
    element.edges = edges;
    element.stiffness = make_hex_element(stiffness_of(material), edges).stiffness;
    return element;
}

}  // namespace lamella
