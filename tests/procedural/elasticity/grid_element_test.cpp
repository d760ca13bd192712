// Element matrices against published numbers and against exact integrals of products of shape functions.
#include "procedural/elasticity/grid_element.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "procedural/elasticity/node_grid.h"

namespace grid_element_test {

using namespace lamella;

namespace {

/// The integral over [0, 1] of the product of two linear shape functions or their derivatives, for the ends
/// a and b of the interval.
double line_integral(unsigned a, unsigned b, bool a_slope, bool b_slope) {
    const double sign_a = a != 0 ? 1 : -1, sign_b = b != 0 ? 1 : -1;
    if (a_slope && b_slope) return sign_a * sign_b;
    if (a_slope) return sign_a / 2;
    if (b_slope) return sign_b / 2;
    return a == b ? 1.0 / 3 : 1.0 / 6;
}

/// The integral over the element of dN_a/dx_i dN_b/dx_j, exact: products of integrals along the axes.
template <std::size_t Dim>
double slopes_integral(unsigned a, unsigned b, std::size_t i, std::size_t j) {
    double product = 1;
    for (std::size_t d = 0; d < Dim; ++d) product *= line_integral(a >> d & 1, b >> d & 1, d == i, d == j);
    return product;
}

/// An entry of the stiffness for Lame's constants: lambda div u div v + 2 mu e(u) : e(v), integrated exactly.
template <std::size_t Dim>
double exact_entry(double lambda, double mu, std::size_t row, std::size_t column) {
    const auto a = static_cast<unsigned>(row / Dim), b = static_cast<unsigned>(column / Dim);
    const std::size_t i = row % Dim, j = column % Dim;
    double sum = lambda * slopes_integral<Dim>(a, b, i, j) + mu * slopes_integral<Dim>(a, b, j, i);
    if (i == j) {
        for (std::size_t d = 0; d < Dim; ++d) sum += mu * slopes_integral<Dim>(a, b, d, d);
    }
    return sum;
}

template <std::size_t Dim>
Eigen::MatrixXd matrix_of(const GridElement<Dim>& element) {
    constexpr auto n = static_cast<Eigen::Index>(GridElement<Dim>::unknowns);
    Eigen::MatrixXd k(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j)
            k(i, j) = element.stiffness[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    return k;
}

}  // namespace

TEST_CASE("the plane stress element has the eight published numbers", "[elasticity]") {
    // Andreassen et al. 2011; corners run counter-clockwise there.
    for (const double nu : {0.3, 0.0, 0.45}) {
        const std::array<double, 8> k{1.0 / 2 - nu / 6,
                                      1.0 / 8 + nu / 8,
                                      -1.0 / 4 - nu / 12,
                                      -1.0 / 8 + 3 * nu / 8,
                                      -1.0 / 4 + nu / 12,
                                      -1.0 / 8 - nu / 8,
                                      nu / 6,
                                      1.0 / 8 - 3 * nu / 8};
        constexpr std::array<std::array<std::size_t, 8>, 8> rows{{{0, 1, 2, 3, 4, 5, 6, 7},
                                                                  {1, 0, 7, 6, 5, 4, 3, 2},
                                                                  {2, 7, 0, 5, 6, 3, 4, 1},
                                                                  {3, 6, 5, 0, 7, 2, 1, 4},
                                                                  {4, 5, 6, 7, 0, 1, 2, 3},
                                                                  {5, 4, 3, 2, 1, 0, 7, 6},
                                                                  {6, 3, 4, 1, 2, 7, 0, 5},
                                                                  {7, 2, 1, 4, 3, 6, 5, 0}}};
        constexpr std::array<std::size_t, 4> corner{0, 1, 3, 2};
        const double young = 2.5;
        const GridElement<2> element = make_plane_stress_element({young, nu});
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t j = 0; j < 8; ++j) {
                CAPTURE(nu, i, j);
                const double ours = element.stiffness[2 * corner[i / 2] + i % 2][2 * corner[j / 2] + j % 2];
                CHECK(ours == Approx(young / (1 - nu * nu) * k[rows[i][j]]).margin(1e-14));
            }
        }
    }
}

TEST_CASE("element matrices equal exact integrals, number for number", "[elasticity]") {
    for (const double nu : {0.3, 0.0, 0.2, 0.45}) {
        const double young = 1.7, mu = young / (2 * (1 + nu));
        const GridElement<2> plane = make_plane_stress_element({young, nu});
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t j = 0; j < 8; ++j) {
                CAPTURE(nu, i, j);
                CHECK(plane.stiffness[i][j] ==
                      Approx(exact_entry<2>(young * nu / (1 - nu * nu), mu, i, j)).margin(1e-14));
            }
        }
        const GridElement<3> solid = make_solid_element({young, nu});
        const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
        for (std::size_t i = 0; i < 24; ++i) {
            for (std::size_t j = 0; j < 24; ++j) {
                CAPTURE(nu, i, j);
                CHECK(solid.stiffness[i][j] == Approx(exact_entry<3>(lambda, mu, i, j)).margin(1e-14));
            }
        }
    }
}

TEST_CASE("a cuboid of any edges has the energy of a uniform strain times its volume", "[elasticity]") {
    const double nu = 0.3, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu));
    const dvec3 edges(1, 0.7, 1.6);
    const GridElement<3> solid = make_solid_element({1, nu}, edges);
    const GridElement<2> plane = make_plane_stress_element({1, nu}, edges);
    CHECK(solid.edges == edges);
    Eigen::Matrix3d gradient;
    gradient << 0.3, -0.2, 0.5, 0.1, 0.4, 0.7, -0.6, 0.2, -0.1;
    Eigen::VectorXd moved(24), moved_in_plane(8);
    for (unsigned c = 0; c < 8; ++c) {
        const Eigen::Vector3d at((c & 1) * edges.x, (c >> 1 & 1) * edges.y, (c >> 2) * edges.z);
        moved.segment<3>(3 * c) = gradient * at;
        if (c < 4) moved_in_plane.segment<2>(2 * c) = gradient.topLeftCorner<2, 2>() * at.head<2>();
    }
    const auto energy = [&](const Eigen::MatrixXd& strain, double first) {
        return first * strain.trace() * strain.trace() + 2 * mu * strain.squaredNorm();
    };
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    CHECK(moved.dot(matrix_of(solid) * moved) ==
          Approx(edges.x * edges.y * edges.z * energy(strain, lambda)).epsilon(1e-12));
    CHECK(
        moved_in_plane.dot(matrix_of(plane) * moved_in_plane) ==
        Approx(edges.x * edges.y * energy(strain.topLeftCorner<2, 2>(), nu / (1 - nu * nu))).epsilon(1e-12));
    // Lengths in another unit scale the stiffness.
    CHECK(matrix_of(make_solid_element({1, nu}, 2.5 * edges)).isApprox(2.5 * matrix_of(solid), 1e-12));
    CHECK(matrix_of(make_plane_stress_element({1, nu}, 2.5 * edges)).isApprox(matrix_of(plane), 1e-12));
}

TEST_CASE("rigid motions of an element cost nothing, and nothing else is free", "[elasticity]") {
    const Eigen::MatrixXd plane = matrix_of(make_plane_stress_element({1, 0.3}));
    const Eigen::MatrixXd solid = matrix_of(make_solid_element({1, 0.3}));
    Eigen::VectorXd turn(8);
    for (unsigned c = 0; c < 4; ++c) {
        turn[2 * c] = -static_cast<double>(c >> 1);
        turn[2 * c + 1] = c & 1;
    }
    CHECK((plane * turn).cwiseAbs().maxCoeff() < 1e-15);
    for (unsigned axis = 0; axis < 3; ++axis) {
        Eigen::VectorXd move = Eigen::VectorXd::Zero(24), spin = Eigen::VectorXd::Zero(24);
        for (unsigned c = 0; c < 8; ++c) {
            const Eigen::Vector3d at(c & 1, c >> 1 & 1, c >> 2);
            move[3 * c + axis] = 1;
            spin.segment<3>(3 * c) = Eigen::Vector3d::Unit(axis).cross(at);
        }
        CHECK((solid * move).cwiseAbs().maxCoeff() < 1e-15);
        CHECK((solid * spin).cwiseAbs().maxCoeff() < 1e-15);
    }
    const auto free_motions = [](const Eigen::MatrixXd& k) {
        const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
        CHECK(values.minCoeff() > -1e-14);
        return (values.array() < 1e-3).count();
    };
    CHECK(free_motions(plane) == 3);
    CHECK(free_motions(solid) == 6);
}

TEST_CASE("every neighbour of a node of a grid has a number of its own in the array", "[elasticity]") {
    for (const glm::ivec3 n : {glm::ivec3(1, 1, 1), glm::ivec3(5, 3, 4), glm::ivec3(16, 2, 1)}) {
        const NodeGrid<3> grid(n);
        const auto steps = grid.neighbour_steps();
        CHECK(grid.size() % NodeGrid<3>::tile == 0);
        std::vector<int> seen(grid.size());
        for (int z = -1; z <= n.z + 1; ++z) {
            for (int y = -1; y <= n.y + 1; ++y) {
                for (int x = -1; x <= n.x + 1; ++x) {
                    REQUIRE(grid.number(x, y, z) < grid.size());
                    ++seen[grid.number(x, y, z)];
                }
            }
        }
        CHECK(*std::max_element(seen.begin(), seen.end()) == 1);
        std::size_t k = 0;
        for (int z = -1; z <= 1; ++z) {
            for (int y = -1; y <= 1; ++y) {
                for (int x = -1; x <= 1; ++x, ++k)
                    CHECK(static_cast<std::ptrdiff_t>(grid.number(n.x, n.y, 0)) + steps[k] ==
                          static_cast<std::ptrdiff_t>(grid.number(n.x + x, n.y + y, z)));
            }
        }
    }
}

}  // namespace grid_element_test
