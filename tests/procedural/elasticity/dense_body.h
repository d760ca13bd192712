// The stiffness of an elastic body as a dense matrix, assembled in the obvious way: the twin of the fast
// paths.
#pragma once

#include <Eigen/Dense>

#include "procedural/elasticity/elastic_body.h"

namespace lamella {

/// Nodes of a grid in the order x, y, z without a margin; unknown Dim * node + direction.
template <std::size_t Dim>
Eigen::Index dense_node(const NodeGrid<Dim>& grid, glm::ivec3 at) {
    const glm::ivec3 n = grid.nodes();
    return at.x + static_cast<Eigen::Index>(n.x) * (at.y + static_cast<Eigen::Index>(n.y) * at.z);
}

template <std::size_t Dim>
Eigen::Index dense_size(const NodeGrid<Dim>& grid) {
    const glm::ivec3 n = grid.nodes();
    return static_cast<Eigen::Index>(Dim) * n.x * n.y * n.z;
}

template <typename Visit>
void for_each_place(glm::ivec3 n, const Visit& visit) {
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) visit(glm::ivec3(x, y, z));
        }
    }
}

/// The elements of a grid; one plane of them in two dimensions.
template <std::size_t Dim>
glm::ivec3 element_box(const NodeGrid<Dim>& grid) {
    return {grid.elements().x, grid.elements().y, Dim == 2 ? 1 : grid.elements().z};
}

/// Sums modulus times the element's stiffness; rows and columns of what is fixed stay.
template <std::size_t Dim, typename Number>
Eigen::MatrixXd dense_stiffness(const ElasticBody<Dim>& body, const std::vector<Number>& moduli) {
    const Eigen::Index size = dense_size(body.grid);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    constexpr unsigned corners = 1U << Dim;
    for_each_place(element_box(body.grid), [&](glm::ivec3 at) {
        const double modulus = static_cast<double>(moduli[body.grid.number(at.x, at.y, at.z)]);
        std::array<Eigen::Index, corners> nodes{};
        for (unsigned c = 0; c < corners; ++c)
            nodes[c] = dense_node(body.grid, at + glm::ivec3(c & 1, c >> 1 & 1, c >> 2 & 1));
        const auto row_of = [&](unsigned unknown) {
            return static_cast<Eigen::Index>(Dim) * nodes[unknown / Dim] +
                   static_cast<Eigen::Index>(unknown % Dim);
        };
        for (unsigned a = 0; a < corners * Dim; ++a) {
            for (unsigned b = 0; b < corners * Dim; ++b)
                k(row_of(a), row_of(b)) += modulus * body.element.stiffness[a][b];
        }
    });
    return k;
}

/// Returns whether each unknown may move.
template <std::size_t Dim>
std::vector<bool> dense_free(const ElasticBody<Dim>& body) {
    std::vector<bool> moves(static_cast<std::size_t>(dense_size(body.grid)));
    for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
        for (std::size_t d = 0; d < Dim; ++d)
            moves[Dim * static_cast<std::size_t>(dense_node(body.grid, at)) + d] =
                (body.fixed[body.grid.number(at.x, at.y, at.z)] >> d & 1) == 0;
    });
    return moves;
}

}  // namespace lamella
