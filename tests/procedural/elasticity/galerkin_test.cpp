// Coarse stencils against the matrix product P^T K P of dense matrices.
#include "procedural/elasticity/galerkin.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/procedural/elasticity/dense_body.h"

namespace galerkin_test {

using namespace lamella;

namespace {

template <std::size_t Dim>
GridElement<Dim> element_of_unit_modulus() {
    if constexpr (Dim == 2) {
        return make_plane_stress_element({1, 0.3});
    } else {
        return make_solid_element({1, 0.3});
    }
}

/// Multilinear interpolation from the nodes of the coarser grid.
template <std::size_t Dim>
Eigen::MatrixXd dense_interpolation(const NodeGrid<Dim>& fine, const NodeGrid<Dim>& coarse) {
    Eigen::MatrixXd p = Eigen::MatrixXd::Zero(dense_size(fine), dense_size(coarse));
    const auto hat = [](int at, int node) { return std::max(0.0, 1 - 0.5 * std::abs(at - 2 * node)); };
    for_each_place(fine.nodes(), [&](glm::ivec3 at) {
        for_each_place(coarse.nodes(), [&](glm::ivec3 node) {
            const double w = hat(at.x, node.x) * hat(at.y, node.y) * (Dim == 2 ? 1 : hat(at.z, node.z));
            for (Eigen::Index d = 0; d < static_cast<Eigen::Index>(Dim); ++d)
                p(static_cast<Eigen::Index>(Dim) * dense_node(fine, at) + d,
                  static_cast<Eigen::Index>(Dim) * dense_node(coarse, node) + d) = w;
        });
    });
    return p;
}

/// The dense matrix that stencils stand for.
template <std::size_t Dim>
Eigen::MatrixXd dense_of(const Stencils<Dim>& stencils) {
    const NodeGrid<Dim>& grid = stencils.grid;
    const Eigen::Index size = dense_size(grid);
    const glm::ivec3 n = grid.nodes();
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    for_each_place(n, [&](glm::ivec3 at) {
        std::size_t neighbour = 0;
        for (int z = Dim == 2 ? 0 : -1; z <= (Dim == 2 ? 0 : 1); ++z) {
            for (int y = -1; y <= 1; ++y) {
                for (int x = -1; x <= 1; ++x, ++neighbour) {
                    const glm::ivec3 other = at + glm::ivec3(x, y, z);
                    const bool inside = other.x >= 0 && other.y >= 0 && other.z >= 0 && other.x < n.x &&
                                        other.y < n.y && other.z < n.z;
                    for (std::size_t i = 0; i < Dim * Dim; ++i) {
                        const auto entry = static_cast<double>(
                            stencils.at(grid.number(at.x, at.y, at.z), neighbour * Dim * Dim + i));
                        if (inside) {
                            k(static_cast<Eigen::Index>(Dim) * dense_node(grid, at) +
                                  static_cast<Eigen::Index>(i / Dim),
                              static_cast<Eigen::Index>(Dim) * dense_node(grid, other) +
                                  static_cast<Eigen::Index>(i % Dim)) = entry;
                        } else {
                            CHECK(entry == 0);
                        }
                    }
                }
            }
        }
    });
    return k;
}

/// Compares both coarsenings of a random body with dense products.
template <std::size_t Dim>
void check_random_body(glm::ivec3 size, unsigned seed, double holes, double held) {
    CAPTURE(Dim, size.x, size.y, size.z, seed, holes, held);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    ElasticBody<Dim> body(NodeGrid<Dim>(size), element_of_unit_modulus<Dim>());
    std::vector<float> moduli(body.grid.size());
    body.for_each_element([&](std::size_t e) {
        body.present[e] = share(random) >= holes;
        if (body.present[e] != 0) moduli[e] = static_cast<float>(std::pow(10.0, -3 * share(random)));
    });
    for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
        if (share(random) < held)
            body.fixed[body.grid.number(at.x, at.y, at.z)] =
                static_cast<std::uint8_t>(random() % (1U << Dim));
    });
    const NodeGrid<Dim> half = coarser(body.grid), quarter = coarser(half);
    const std::vector<std::uint8_t> parents = coarse_elements(body.grid, body.present);
    Stencils<Dim> once(half), twice(quarter);
    coarsen(body, moduli, used_nodes(half, parents), once);
    coarsen(once, twice);

    Eigen::MatrixXd p = dense_interpolation(body.grid, half);
    const std::vector<bool> moves = dense_free(body);
    for (Eigen::Index row = 0; row < p.rows(); ++row) {
        if (!moves[static_cast<std::size_t>(row)]) p.row(row).setZero();
    }
    const Eigen::MatrixXd expected = p.transpose() * dense_stiffness(body, moduli) * p;
    const double scale = expected.cwiseAbs().maxCoeff();
    REQUIRE(scale > 0);
    CHECK((dense_of(once) - expected).cwiseAbs().maxCoeff() < 1e-6 * scale);
    const Eigen::MatrixXd q = dense_interpolation(half, quarter);
    const Eigen::MatrixXd next = q.transpose() * expected * q;
    CHECK((dense_of(twice) - next).cwiseAbs().maxCoeff() < 1e-6 * next.cwiseAbs().maxCoeff());
}

}  // namespace

TEST_CASE("coarse stencils of a body in the plane are P^T K P", "[elasticity]") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        check_random_body<2>({8, 4, 1}, seed, 0, 0);
        check_random_body<2>({7, 5, 1}, seed, 0, 0.2);
        check_random_body<2>({9, 1, 1}, seed, 0.2, 0.2);
        check_random_body<2>({1, 1, 1}, seed, 0, 0.2);
        check_random_body<2>({21, 3, 1}, seed, 0.3, 0.1);
    }
}

TEST_CASE("coarse stencils of a solid body are P^T K P", "[elasticity]") {
    for (unsigned seed = 1; seed <= 2; ++seed) {
        check_random_body<3>({4, 4, 2}, seed, 0, 0);
        check_random_body<3>({5, 3, 4}, seed, 0.2, 0.2);
        check_random_body<3>({7, 1, 2}, seed, 0.2, 0.2);
        check_random_body<3>({1, 1, 1}, seed, 0, 0.3);
    }
}

TEST_CASE("a coarse element is there if one of its children is", "[elasticity]") {
    const NodeGrid<3> fine({5, 3, 1});
    std::vector<std::uint8_t> present(fine.size());
    present[fine.number(4, 2, 0)] = present[fine.number(1, 1, 0)] = 1;
    const NodeGrid<3> coarse = coarser(fine);
    CHECK(coarse.elements() == glm::ivec3(3, 2, 1));
    const std::vector<std::uint8_t> parents = coarse_elements(fine, present);
    for_each_place(coarse.elements(), [&](glm::ivec3 at) {
        const bool expected = at == glm::ivec3(2, 1, 0) || at == glm::ivec3(0, 0, 0);
        CHECK((parents[coarse.number(at.x, at.y, at.z)] != 0) == expected);
    });
}

}  // namespace galerkin_test
