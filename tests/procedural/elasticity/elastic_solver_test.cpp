// Displacements of bodies under loads, against closed forms, beam theory and a dense direct solve.
#include "procedural/elasticity/elastic_solver.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "engine/base/error.h"
#include "engine/base/simd_target.h"
#include "tests/procedural/elasticity/dense_body.h"

namespace elastic_solver_test {

using namespace lamella;

namespace {

template <std::size_t Dim>
ElasticBody<Dim> block(glm::ivec3 size, double poisson = 0.3) {
    if constexpr (Dim == 2) {
        return ElasticBody<2>(NodeGrid<2>(size), make_plane_stress_element({1, poisson}));
    } else {
        return ElasticBody<3>(NodeGrid<3>(size), make_solid_element({1, poisson}));
    }
}

template <std::size_t Dim>
std::vector<double> same_modulus(const ElasticBody<Dim>& body, double modulus) {
    std::vector<double> moduli(body.grid.size());
    body.for_each_element([&](std::size_t e) { moduli[e] = modulus; });
    return moduli;
}

/// Adds a traction on the elements' faces at the end of the grid along an axis: `at(middle of the face)` is
/// the force per area, taken as constant over each element.
template <std::size_t Dim>
void add_traction(const NodeGrid<Dim>& grid, std::size_t axis, bool upper,
                  const std::function<std::array<double, Dim>(glm::dvec3)>& at,
                  NodalVector<Dim, double>& forces) {
    const int a = static_cast<int>(axis);
    const glm::ivec3 n = element_box(grid);
    for_each_place(n, [&](glm::ivec3 element) {
        if (element[a] != (upper ? n[a] - 1 : 0)) return;
        glm::dvec3 middle = glm::dvec3(element) + 0.5;
        middle[a] = upper ? n[a] : 0;
        const std::array<double, Dim> traction = at(middle);
        for (unsigned c = 0; c < (1U << Dim); ++c) {
            if ((c >> axis & 1) != (upper ? 1U : 0U)) continue;
            const glm::ivec3 node = element + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
            for (std::size_t d = 0; d < Dim; ++d)
                forces.along[d][grid.number(node.x, node.y, node.z)] += traction[d] / (1U << (Dim - 1));
        }
    });
}

/// Moduli over three decades, with holes and nodes held at random.
template <std::size_t Dim>
struct RandomCase {
    ElasticBody<Dim> body;
    std::vector<double> moduli;
    NodalVector<Dim, double> forces;

    RandomCase(glm::ivec3 size, unsigned seed, double holes, double held)
        : body(block<Dim>(size)), moduli(body.grid.size()), forces(body.grid.size()) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> share(0, 1);
        body.for_each_element([&](std::size_t e) {
            body.present[e] = share(random) >= holes;
            if (body.present[e] != 0) moduli[e] = std::pow(10.0, -3 * share(random));
        });
        for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
            const std::size_t node = body.grid.number(at.x, at.y, at.z);
            if (share(random) < held) body.fixed[node] = static_cast<std::uint8_t>(random() % (1U << Dim));
            for (std::size_t d = 0; d < Dim; ++d) forces.along[d][node] = share(random) - 0.5;
        });
    }
};

/// Solves a random case both ways. Returns false if the case is singular: a part is loose.
template <std::size_t Dim>
bool solves_as_dense(glm::ivec3 size, unsigned seed, double holes, double held) {
    RandomCase<Dim> c(size, seed, holes, held);
    const Eigen::MatrixXd all = dense_stiffness(c.body, c.moduli);
    const std::vector<bool> moves = dense_free(c.body);
    std::vector<std::pair<std::size_t, std::size_t>> unknowns;
    std::vector<Eigen::Index> rows;
    for_each_place(c.body.grid.nodes(), [&](glm::ivec3 at) {
        for (std::size_t d = 0; d < Dim; ++d) {
            const auto row =
                static_cast<Eigen::Index>(Dim) * dense_node(c.body.grid, at) + static_cast<Eigen::Index>(d);
            const std::size_t node = c.body.grid.number(at.x, at.y, at.z);
            if (all(row, row) == 0) c.forces.along[d][node] = 0;  // touches no element
            if (!moves[static_cast<std::size_t>(row)] || all(row, row) == 0) continue;
            unknowns.emplace_back(node, d);
            rows.push_back(row);
        }
    });
    if (rows.empty()) return false;
    const Eigen::MatrixXd k = all(rows, rows);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    if (values.minCoeff() < 1e-7 * values.maxCoeff()) return false;
    Eigen::VectorXd f(k.rows());
    for (Eigen::Index i = 0; i < f.size(); ++i) {
        const auto [node, d] = unknowns[static_cast<std::size_t>(i)];
        f[i] = c.forces.along[d][node];
    }
    const Eigen::VectorXd expected = k.ldlt().solve(f);

    CAPTURE(Dim, size.x, size.y, size.z, seed, holes, held);
    ElasticSolver<Dim> solver(c.body, {.tolerance = 1e-11});
    solver.set_moduli(c.moduli);
    NodalVector<Dim, double> u(c.body.grid.size());
    // The first guess must not matter, nor what it says of nodes that are held.
    for (auto& along : u.along) std::ranges::fill(along, seed % 2 == 0 ? 0.0 : 1.0);
    solver.solve(c.forces, u);
    double worst = 0;
    for (Eigen::Index i = 0; i < f.size(); ++i) {
        const auto [node, d] = unknowns[static_cast<std::size_t>(i)];
        worst = std::max(worst, std::abs(u.along[d][node] - expected[i]));
    }
    CHECK(worst < 1e-7 * expected.cwiseAbs().maxCoeff());
    CHECK(solver.work(c.forces, u) == Approx(f.dot(expected)).epsilon(1e-9));
    const std::vector<double> energies = solver.unit_energies(u);
    double energy = 0;
    for (std::size_t e = 0; e < energies.size(); ++e) energy += energies[e] * c.moduli[e];
    CHECK(energy == Approx(f.dot(expected)).epsilon(1e-9));
    for_each_place(c.body.grid.nodes(), [&](glm::ivec3 at) {
        const std::size_t node = c.body.grid.number(at.x, at.y, at.z);
        for (std::size_t d = 0; d < Dim; ++d) {
            const auto row =
                static_cast<Eigen::Index>(Dim) * dense_node(c.body.grid, at) + static_cast<Eigen::Index>(d);
            if ((c.body.fixed[node] >> d & 1) != 0 && all(row, row) > 0) CHECK(u.along[d][node] == 0);
        }
    });
    return true;
}

/// The compliance of a clamped beam, its free end pulled down by a force of 1 that is spread like the shear
/// stress of beam theory.
template <std::size_t Dim>
double cantilever(int length, int height, int width) {
    ElasticBody<Dim> body = block<Dim>({length, height, width});
    const glm::ivec3 n = body.grid.nodes();
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) body.fixed[body.grid.number(0, y, z)] = (1U << Dim) - 1;
    }
    NodalVector<Dim, double> forces(body.grid.size()), u(body.grid.size());
    const double area = height * (Dim == 2 ? 1 : width);
    add_traction<Dim>(
        body.grid, 0, true,
        [&](glm::dvec3 at) {
            const double s = 2 * at.y / height - 1;
            // The mean of the parabola over the element.
            const double third = 1.0 / (3.0 * height * height);
            std::array<double, Dim> traction{};
            traction[1] = -1.5 * (1 - s * s - third) / area;
            return traction;
        },
        forces);
    ElasticSolver<Dim> solver(body, {.tolerance = 1e-9});
    solver.set_moduli(same_modulus(body, 1));
    solver.solve(forces, u);
    return solver.work(forces, u);
}

/// Bending and shear (Timoshenko), shear coefficient 5/6; in the plane the width is 1.
double beam_compliance(double length, double height, double width) {
    const double inertia = width * height * height * height / 12, shear = 1 / (2 * 1.3);
    return length * length * length / (3 * inertia) + length / (5.0 / 6 * shear * width * height);
}

template <std::size_t Dim>
int iterations_of(glm::ivec3 size, double softest) {
    ElasticBody<Dim> body = block<Dim>(size);
    const glm::ivec3 n = body.grid.nodes();
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) body.fixed[body.grid.number(0, y, z)] = (1U << Dim) - 1;
    }
    // A smooth lattice of members and holes, drawn on whatever grid the body has.
    std::vector<double> moduli(body.grid.size());
    for_each_place(element_box(body.grid), [&](glm::ivec3 at) {
        const glm::dvec3 turn = 18.0 * (glm::dvec3(at) + 0.5) / glm::dvec3(size);
        const double wave = std::sin(turn.x) + std::sin(turn.y + 1) + (Dim == 2 ? 0 : std::sin(turn.z + 2));
        const double density = std::clamp(0.5 + 0.7 * wave, 0.0, 1.0);
        moduli[body.grid.number(at.x, at.y, at.z)] = softest + (1 - softest) * density * density * density;
    });
    NodalVector<Dim, double> forces(body.grid.size()), u(body.grid.size());
    forces.along[1][body.grid.number(n.x - 1, n.y / 2, n.z / 2)] = 1;
    ElasticSolver<Dim> solver(body, {.tolerance = 1e-5});
    solver.set_moduli(moduli);
    return solver.solve(forces, u);
}

template <std::size_t Dim>
NodalVector<Dim, double> solved(const RandomCase<Dim>& c, std::vector<double>& energies) {
    ElasticSolver<Dim> solver(c.body, {.tolerance = 1e-6});
    solver.set_moduli(c.moduli);
    NodalVector<Dim, double> u(c.body.grid.size());
    solver.solve(c.forces, u);
    energies = solver.unit_energies(u);
    return u;
}

/// Solves on every SIMD target and on 1, 2 and 4 threads, and compares bits.
template <std::size_t Dim>
void check_same_bits(glm::ivec3 size) {
    const RandomCase<Dim> c(size, 5, 0, 0.3);
    std::vector<double> expected_energies;
    const NodalVector<Dim, double> expected = solved(c, expected_energies);
    REQUIRE(expected_energies[c.body.grid.number(1, 1, 0)] > 0);
    const auto check = [&] {
        std::vector<double> energies;
        const NodalVector<Dim, double> u = solved(c, energies);
        for (std::size_t d = 0; d < Dim; ++d) CHECK(u.along[d] == expected.along[d]);
        CHECK(energies == expected_energies);
    };
    for (const std::string& target : simd_targets()) {
        CAPTURE(target);
        force_simd_target(target);
        check();
        force_simd_target("");
    }
    for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        ThreadArena(threads).execute(check);
    }
}

}  // namespace

TEST_CASE("a bar in tension has the compliance length over section", "[elasticity]") {
    for (const glm::ivec3 n :
         {glm::ivec3(10, 3, 1), glm::ivec3(1, 1, 1), glm::ivec3(64, 32, 1), glm::ivec3(3, 17, 1)}) {
        CAPTURE(n.x, n.y);
        ElasticBody<2> body = block<2>(n);
        for (int y = 0; y <= n.y; ++y) body.fixed[body.grid.number(0, y, 0)] = 1;
        body.fixed[body.grid.number(0, 0, 0)] = 3;
        NodalVector<2, double> forces(body.grid.size()), u(body.grid.size());
        add_traction<2>(
            body.grid, 0, true,
            [&](glm::dvec3) {
                return std::array<double, 2>{1.0 / n.y, 0};
            },
            forces);
        ElasticSolver<2> solver(body, {.tolerance = 1e-12});
        solver.set_moduli(same_modulus(body, 1));
        solver.solve(forces, u);
        CHECK(solver.work(forces, u) == Approx(static_cast<double>(n.x) / n.y).epsilon(1e-9));
        solver.set_moduli(same_modulus(body, 4));
        solver.solve(forces, u);
        CHECK(solver.work(forces, u) == Approx(static_cast<double>(n.x) / n.y / 4).epsilon(1e-9));
    }
}

TEST_CASE("uniform strains of a block in the plane are exact", "[elasticity]") {
    const glm::ivec3 n(9, 6, 1);
    const double nu = 0.3;
    for (const std::array<double, 3>& strain :
         {std::array<double, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, -0.7, 0.5}}) {
        ElasticBody<2> body = block<2>(n, nu);
        // No force acts where the block is held: only rigid motions are kept out.
        body.fixed[body.grid.number(0, 0, 0)] = 3;
        body.fixed[body.grid.number(n.x, 0, 0)] = 2;
        const double e = 1 / (1 - nu * nu), xx = e * (strain[0] + nu * strain[1]),
                     yy = e * (strain[1] + nu * strain[0]), xy = strain[2] / (2 * (1 + nu));
        NodalVector<2, double> forces(body.grid.size()), u(body.grid.size());
        for (const bool upper : {false, true}) {
            const double sign = upper ? 1 : -1;
            add_traction<2>(
                body.grid, 0, upper,
                [&](glm::dvec3) {
                    return std::array<double, 2>{sign * xx, sign * xy};
                },
                forces);
            add_traction<2>(
                body.grid, 1, upper,
                [&](glm::dvec3) {
                    return std::array<double, 2>{sign * xy, sign * yy};
                },
                forces);
        }
        ElasticSolver<2> solver(body, {.tolerance = 1e-12});
        solver.set_moduli(same_modulus(body, 1));
        solver.solve(forces, u);
        double worst = 0;
        for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
            const std::size_t node = body.grid.number(at.x, at.y, 0);
            worst = std::max({worst, std::abs(u.along[0][node] - (strain[0] * at.x + strain[2] * at.y)),
                              std::abs(u.along[1][node] - strain[1] * at.y)});
        });
        CHECK(worst < 1e-9);
    }
}

TEST_CASE("uniform strains of a solid block are exact", "[elasticity]") {
    const glm::ivec3 n(5, 3, 4);
    const double nu = 0.3, lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 1 / (2 * (1 + nu));
    // Strains xx, yy, zz and the engineering shears xy, yz, zx.
    for (const std::array<double, 6>& strain : {std::array<double, 6>{1, 0, 0, 0, 0, 0},
                                                {0, 0, 1, 0, 0, 0},
                                                {0, 0, 0, 1, 0, 0},
                                                {0, 0, 0, 0, 1, 0},
                                                {0, 0, 0, 0, 0, 1},
                                                {0.2, -0.6, 0.4, 0.5, -0.3, 0.7}}) {
        ElasticBody<3> body = block<3>(n, nu);
        body.fixed[body.grid.number(0, 0, 0)] = 7;
        body.fixed[body.grid.number(n.x, 0, 0)] = 6;
        body.fixed[body.grid.number(0, n.y, 0)] = 4;
        const double trace = lambda * (strain[0] + strain[1] + strain[2]);
        const std::array<std::array<double, 3>, 3> stress{
            {{trace + 2 * mu * strain[0], mu * strain[3], mu * strain[5]},
             {mu * strain[3], trace + 2 * mu * strain[1], mu * strain[4]},
             {mu * strain[5], mu * strain[4], trace + 2 * mu * strain[2]}}};
        NodalVector<3, double> forces(body.grid.size()), u(body.grid.size());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool upper : {false, true}) {
                std::array<double, 3> traction = stress[axis];
                for (double& t : traction) t *= upper ? 1 : -1;
                add_traction<3>(
                    body.grid, axis, upper, [&](glm::dvec3) { return traction; }, forces);
            }
        }
        ElasticSolver<3> solver(body, {.tolerance = 1e-12});
        solver.set_moduli(same_modulus(body, 1));
        solver.solve(forces, u);
        double worst = 0;
        for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
            const std::size_t node = body.grid.number(at.x, at.y, at.z);
            const std::array<double, 3> expected{strain[0] * at.x + strain[3] * at.y + strain[5] * at.z,
                                                 strain[1] * at.y + strain[4] * at.z, strain[2] * at.z};
            for (std::size_t d = 0; d < 3; ++d)
                worst = std::max(worst, std::abs(u.along[d][node] - expected[d]));
        });
        CHECK(worst < 1e-9);
    }
}

TEST_CASE("the energy of a linear displacement is that of its strain, element by element", "[elasticity]") {
    const ElasticBody<2> body = [] {
        ElasticBody<2> held = block<2>({4, 3, 1});
        held.fixed[held.grid.number(0, 0, 0)] = 3;
        held.present[held.grid.number(1, 1, 0)] = 0;
        return held;
    }();
    ElasticSolver<2> solver(body, {});
    NodalVector<2, double> u(body.grid.size());
    for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
        u.along[0][body.grid.number(at.x, at.y, 0)] = 2 * at.x + 5 + 0.5 * at.y;
        u.along[1][body.grid.number(at.x, at.y, 0)] = -0.5 * at.x + 7;
    });
    const std::vector<double> energies = solver.unit_energies(u);
    body.for_each_element([&](std::size_t e) {
        const double expected = body.present[e] != 0 ? 2 * 2 / (1 - 0.3 * 0.3) : 0;
        CHECK(energies[e] == Approx(expected).epsilon(1e-12));
    });
}

TEST_CASE("pure bending of a beam converges with the square of the element size", "[elasticity]") {
    // Held so that the exact solution of elasticity is that of beam theory: u_x = k x y, and k L^2 / 2 down.
    double before = 0;
    for (const int height : {2, 4, 8, 16}) {
        const int length = 5 * height;
        ElasticBody<2> body = block<2>({length, height, 1});
        for (int y = 0; y <= height; ++y) body.fixed[body.grid.number(0, y, 0)] = 1;
        body.fixed[body.grid.number(0, height / 2, 0)] = 3;
        NodalVector<2, double> forces(body.grid.size()), u(body.grid.size());
        const double k = 1.0 / height;
        add_traction<2>(
            body.grid, 0, true,
            [&](glm::dvec3 at) {
                return std::array<double, 2>{k * (at.y - 0.5 * height), 0};
            },
            forces);
        ElasticSolver<2> solver(body, {.tolerance = 1e-10});
        solver.set_moduli(same_modulus(body, 1));
        solver.solve(forces, u);
        const double exact = -k * length * length / 2;
        const double error = std::abs(u.along[1][body.grid.number(length, height / 2, 0)] / exact - 1);
        CAPTURE(height, error, before);
        if (before > 0) CHECK(before / error == Approx(4).epsilon(0.1));
        before = error;
    }
    CHECK(before < 0.006);
}

TEST_CASE("a cantilever in the plane bends and shears as beam theory says", "[elasticity]") {
    double before = 1;
    for (const int height : {4, 8, 16}) {
        const double error = std::abs(cantilever<2>(10 * height, height, 1) / beam_compliance(10, 1, 1) - 1);
        CAPTURE(height, error);
        CHECK(error < 0.5 * before);
        before = error;
    }
    CHECK(before < 0.005);  // the share of shear is 0.008
}

TEST_CASE("a solid cantilever bends and shears as beam theory says", "[elasticity]") {
    double before = 1;
    for (const int height : {2, 4, 8}) {
        // The modulus of edge h is h times that of edge 1: a beam of unit section.
        const double found = cantilever<3>(10 * height, height, height) * height;
        const double error = std::abs(found / beam_compliance(10, 1, 1) - 1);
        CAPTURE(height, error);
        CHECK(error < 0.5 * before);
        before = error;
    }
    CHECK(before < 0.02);
}

TEST_CASE("solutions in the plane equal those of a dense direct solver", "[elasticity]") {
    int solved = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        for (const glm::ivec3 size : {glm::ivec3(8, 8, 1), glm::ivec3(7, 5, 1), glm::ivec3(21, 3, 1),
                                      glm::ivec3(9, 1, 1), glm::ivec3(1, 1, 1)}) {
            solved += solves_as_dense<2>(size, seed, 0, 0.15) ? 1 : 0;
            solved += solves_as_dense<2>(size, seed, 0.2, 0.4) ? 1 : 0;
        }
    }
    CHECK(solved > 40);
}

TEST_CASE("solutions in space equal those of a dense direct solver", "[elasticity]") {
    int solved = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        for (const glm::ivec3 size :
             {glm::ivec3(5, 3, 4), glm::ivec3(7, 1, 2), glm::ivec3(1, 1, 1), glm::ivec3(4, 4, 4)}) {
            solved += solves_as_dense<3>(size, seed, 0, 0.15) ? 1 : 0;
            solved += solves_as_dense<3>(size, seed, 0.3, 0.4) ? 1 : 0;
        }
    }
    CHECK(solved > 12);
}

TEST_CASE("displacements have the same bits on every SIMD target and number of threads", "[elasticity]") {
    check_same_bits<2>({67, 45, 1});
    check_same_bits<3>({19, 15, 13});
}

TEST_CASE("the number of iterations hardly grows with the body", "[elasticity]") {
    for (const double softest : {1.0, 1e-3, 1e-9}) {
        const int small = iterations_of<2>({32, 32, 1}, softest),
                  large = iterations_of<2>({256, 256, 1}, softest);
        CAPTURE(softest, small, large);
        CHECK(large <= small + 6);
        CHECK(large <= 25);
    }
    for (const double softest : {1.0, 1e-3, 1e-6}) {
        const int small = iterations_of<3>({12, 12, 12}, softest),
                  large = iterations_of<3>({48, 48, 48}, softest);
        CAPTURE(softest, small, large);
        CHECK(large <= small + 6);
        CHECK(large <= 25);
    }
}

TEST_CASE("a second solve from the solution takes no iteration", "[elasticity]") {
    const RandomCase<2> c({16, 8, 1}, 3, 0, 0.3);
    ElasticSolver<2> solver(c.body, {});
    solver.set_moduli(c.moduli);
    NodalVector<2, double> u(c.body.grid.size());
    CHECK(solver.solve(c.forces, u) > 2);
    CHECK(solver.solve(c.forces, u) <= 1);
}

TEST_CASE("a body without loads does not move", "[elasticity]") {
    const RandomCase<2> c({16, 8, 1}, 3, 0, 0.3);
    ElasticSolver<2> solver(c.body, {});
    solver.set_moduli(c.moduli);
    const NodalVector<2, double> none(c.body.grid.size());
    NodalVector<2, double> u(c.body.grid.size());
    CHECK(solver.solve(none, u) == 0);
    CHECK(u.along == none.along);
}

TEST_CASE("a body that is not held, or not there, is refused", "[elasticity]") {
    CHECK_THROWS_WITH(ElasticSolver<2>(block<2>({3, 3, 1}), {}), Catch::Contains("not held"));
    ElasticBody<3> nothing = block<3>({3, 3, 3});
    std::ranges::fill(nothing.present, std::uint8_t{0});
    nothing.fixed[nothing.grid.number(0, 0, 0)] = 7;
    CHECK_THROWS_AS(ElasticSolver<3>(nothing, {}), InputError);
    // Held only where there is no element.
    ElasticBody<2> beside = block<2>({4, 1, 1});
    beside.present[beside.grid.number(3, 0, 0)] = 0;
    beside.fixed[beside.grid.number(4, 0, 0)] = 3;
    CHECK_THROWS_AS(ElasticSolver<2>(beside, {}), InputError);
    ElasticBody<2> held = block<2>({4, 1, 1});
    held.fixed[held.grid.number(0, 0, 0)] = 3;
    ElasticSolver<2> solver(held, {});
    CHECK_THROWS_AS(solver.set_moduli({1, 2, 3}), InputError);
}

TEST_CASE("a solver that may not iterate says so", "[elasticity]") {
    const RandomCase<2> c({16, 8, 1}, 3, 0, 0.3);
    ElasticSolver<2> solver(c.body, {.max_iterations = 1});
    solver.set_moduli(c.moduli);
    NodalVector<2, double> u(c.body.grid.size());
    CHECK_THROWS_AS(solver.solve(c.forces, u), FaultError);
}

TEST_CASE("a cancelled solver stops", "[elasticity]") {
    const RandomCase<2> c({16, 8, 1}, 3, 0, 0.3);
    CancelToken cancel;
    ElasticSolver<2> solver(c.body, {.cancel = &cancel});
    solver.set_moduli(c.moduli);
    NodalVector<2, double> u(c.body.grid.size());
    cancel.cancel();
    CHECK_THROWS_AS(solver.solve(c.forces, u), Interrupted);
    CHECK_THROWS_AS(solver.set_moduli(c.moduli), Interrupted);
}

}  // namespace elastic_solver_test
