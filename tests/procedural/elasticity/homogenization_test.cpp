// Homogenisation against closed forms, published tensors, and an assembled matrix solved directly.
#include "procedural/elasticity/homogenization.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "engine/base/error.h"
#include "procedural/elasticity/elastic_multigrid.h"
#include "procedural/elasticity/hex_element.h"

namespace homogenization_test {

using namespace lamella;

namespace {

ElementMask sample_of(glm::ivec3 size, const std::function<bool(int, int, int)>& solid) {
    ElementMask sample{size, {}};
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) sample.present.push_back(solid(x, y, z) ? 1 : 0);
        }
    }
    return sample;
}

/// Blobs: elements are solid by a smooth random pattern, so that pieces hold together.
ElementMask random_sample(glm::ivec3 size, unsigned seed, double share) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> phase(0, 6.283185307179586);
    std::array<double, 9> p;
    for (double& v : p) v = phase(random);
    std::vector<double> values;
    const auto value = [&](int x, int y, int z) {
        const double a = 6.283185307179586 * x / size.x, b = 6.283185307179586 * y / size.y,
                     c = 6.283185307179586 * z / size.z;
        return std::sin(a + p[0]) * std::sin(b + p[1]) + std::sin(b + p[2]) * std::sin(c + p[3]) +
               std::sin(c + p[4]) * std::sin(a + p[5]) + 0.4 * std::sin(a + b + p[6]) +
               0.4 * std::sin(b - c + p[7]) + 0.3 * std::sin(2 * c + p[8]);
    };
    sample_of(size, [&](int x, int y, int z) {
        values.push_back(value(x, y, z));
        return true;
    });
    std::ranges::sort(values);
    const double level = values[static_cast<std::size_t>((1 - share) * static_cast<double>(values.size()))];
    return sample_of(size, [&](int x, int y, int z) { return value(x, y, z) >= level; });
}

HomogenizationOptions exactly() {
    HomogenizationOptions options;
    options.tolerance = 1e-11;
    return options;
}

double difference(const ElasticTensor& a, const ElasticTensor& b) {
    double most = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) most = std::max(most, std::abs(a[i][j] - b[i][j]));
    }
    return most;
}

/// The tensor by the textbook: an assembled matrix over all nodes, what nothing holds left out by its
/// eigenvalues.
ElasticTensor assembled(const ElementMask& sample, const IsotropicMaterial& material) {
    const HexElement element = make_hex_element(stiffness_of(material));
    const glm::ivec3 n = sample.size;
    const int unknowns = 3 * n.x * n.y * n.z;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(unknowns, unknowns), f = Eigen::MatrixXd::Zero(unknowns, 6);
    double solid = 0;
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) {
                if (!sample.at(x, y, z)) continue;
                ++solid;
                std::array<int, hex_unknowns> at;
                for (int c = 0; c < hex_nodes; ++c) {
                    const int node = (x + (c & 1)) % n.x +
                                     n.x * ((y + (c >> 1 & 1)) % n.y + n.y * ((z + (c >> 2 & 1)) % n.z));
                    for (int i = 0; i < 3; ++i) at[static_cast<std::size_t>(3 * c + i)] = 3 * node + i;
                }
                for (std::size_t u = 0; u < hex_unknowns; ++u) {
                    for (std::size_t v = 0; v < hex_unknowns; ++v) k(at[u], at[v]) += element.stiffness[u][v];
                    for (std::size_t j = 0; j < 6; ++j) f(at[u], static_cast<int>(j)) += element.loads[u][j];
                }
            }
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k);
    Eigen::VectorXd inverse = modes.eigenvalues();
    for (double& v : inverse) v = v > 1e-10 ? 1 / v : 0;
    const Eigen::MatrixXd g = modes.eigenvectors().transpose() * f;
    const Eigen::MatrixXd saved = g.transpose() * inverse.asDiagonal() * g;
    const double volume = unknowns / 3.0;
    ElasticTensor c = stiffness_of(material);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            c[i][j] = c[i][j] * solid / volume - saved(static_cast<int>(i), static_cast<int>(j)) / volume;
    }
    return c;
}

/// Whether a tensor is that of something no stiffer, under every strain, than another.
bool is_below(const ElasticTensor& a, const ElasticTensor& b) {
    Eigen::Matrix<double, 6, 6> rest;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            rest(static_cast<int>(i), static_cast<int>(j)) = b[i][j] - a[i][j];
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(rest).eigenvalues().minCoeff() > -1e-12;
}

}  // namespace

TEST_CASE("a full block is as stiff as its material", "[elasticity]") {
    for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(8), glm::ivec3(6, 4, 2), glm::ivec3(5, 3, 7)}) {
        const IsotropicMaterial material{1, 0.3};
        const Homogenized full = homogenize(sample_of(size, [](int, int, int) { return true; }), material);
        CHECK(difference(full.stiffness, stiffness_of(material)) < 1e-12);
        CHECK(full.stiffness[0][0] == Approx(1.34615).margin(5e-6));
        CHECK(full.stiffness[0][1] == Approx(0.57692).margin(5e-6));
        CHECK(full.stiffness[3][3] == Approx(0.38462).margin(5e-6));
        CHECK(full.density == 1);
    }
}

TEST_CASE("a layer with void about it is a plate under plane stress", "[elasticity]") {
    const double nu = 0.3;
    for (const int n : {2, 7, 16}) {
        const Homogenized layer =
            homogenize(sample_of({n, n, 2 * n}, [&](int, int, int z) { return z < n; }), {1, nu}, exactly());
        ElasticTensor plate{};
        plate[0][0] = plate[1][1] = 0.5 / (1 - nu * nu);
        plate[0][1] = plate[1][0] = nu * plate[0][0];
        plate[3][3] = 0.25 / (1 + nu);
        CHECK(difference(layer.stiffness, plate) < 1e-10);
    }
}

TEST_CASE("a bar carries along itself alone", "[elasticity]") {
    const Homogenized bar = homogenize(sample_of({4, 8, 8}, [](int, int y, int z) { return y < 4 && z < 4; }),
                                       {3, 0.25}, exactly());
    ElasticTensor along{};
    along[0][0] = 3 * 0.25;
    CHECK(difference(bar.stiffness, along) < 1e-9);
}

TEST_CASE("the grid of a published program has its published tensor", "[elasticity]") {
    // Dong, Tang, Zhao, "A 149 line homogenization code for three-dimensional cellular materials" (2018):
    // struts of radius 0.1 along the edges of a cube, 40^3 elements, Lame's constants 115.4 and 79.6.
    constexpr int n = 40;
    const auto near = [](int a, int b) {
        const auto off = [](int i) { return std::min(i + 0.5, n - i - 0.5) / n; };
        return off(a) * off(a) + off(b) * off(b) <= 0.01 + 1e-12;
    };
    const Homogenized grid = homogenize(
        sample_of({n, n, n}, [&](int x, int y, int z) { return near(x, y) || near(y, z) || near(z, x); }),
        material_of(115.4 + 2.0 / 3 * 79.6, 79.6));
    CHECK(grid.density == Approx(0.085).margin(0.0006));
    CHECK(grid.stiffness[0][0] == Approx(7.1876).margin(0.00005));
    CHECK(grid.stiffness[0][1] == Approx(0.3875).margin(0.00005));
    CHECK(grid.stiffness[3][3] == Approx(0.1489).margin(0.00005));
    CHECK(std::abs(grid.stiffness[0][3]) < 1e-8);
    CHECK(grid.iterations < 30);
}

TEST_CASE("tensors are those of an assembled matrix", "[elasticity]") {
    const IsotropicMaterial material{2, 0.35};
    for (const unsigned seed : {1U, 2U, 3U}) {
        for (const glm::ivec3 size : {glm::ivec3(6), glm::ivec3(8, 4, 6), glm::ivec3(5, 6, 7)}) {
            const ElementMask sample = random_sample(size, seed, 0.4);
            CHECK(difference(homogenize(sample, material, exactly()).stiffness, assembled(sample, material)) <
                  1e-9);
        }
    }
    // Pieces that nothing holds, and elements that meet at an edge or a corner.
    const ElementMask loose = sample_of({6, 6, 6}, [](int x, int y, int z) {
        return (x < 2 && y < 2) || (x == 3 && y == 3 && z == 3) || (x == 4 && y == 4 && z == 4) ||
               (x == 2 && y == 2 && z == 5);
    });
    CHECK(difference(homogenize(loose, material, exactly()).stiffness, assembled(loose, material)) < 1e-9);
}

TEST_CASE("a sample may begin anywhere and lie any way", "[elasticity]") {
    constexpr int n = 12;
    const ElementMask sample = random_sample({n, n, n}, 7, 0.35);
    const IsotropicMaterial material{1, 0.3};
    const ElasticTensor c = homogenize(sample, material, exactly()).stiffness;
    const ElementMask moved = sample_of(
        sample.size, [&](int x, int y, int z) { return sample.at((x + 5) % n, (y + 3) % n, (z + 10) % n); });
    CHECK(difference(homogenize(moved, material, exactly()).stiffness, c) < 1e-10);
    const ElementMask turned =
        sample_of(sample.size, [&](int x, int y, int z) { return sample.at(z, x, y); });
    const ElasticTensor t = homogenize(turned, material, exactly()).stiffness;
    const std::array<std::size_t, 6> to{2, 0, 1, 5, 3, 4};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) CHECK(t[to[i]][to[j]] == Approx(c[i][j]).margin(1e-10));
    }
    IsotropicMaterial stiffer = material;
    stiffer.young = 2000;
    ElasticTensor scaled = homogenize(sample, stiffer, exactly()).stiffness;
    for (auto& row : scaled) {
        for (double& v : row) v /= 2000;
    }
    CHECK(difference(scaled, c) < 1e-10);
}

TEST_CASE("no structure is stiffer than its share of material, nor loses work", "[elasticity]") {
    for (const double share : {0.2, 0.5, 0.8}) {
        const ElementMask sample = random_sample({16, 16, 16}, 11, share);
        const IsotropicMaterial material{1, 0.4};
        const Homogenized found = homogenize(sample, material);
        ElasticTensor voigt = stiffness_of(material);
        for (auto& row : voigt) {
            for (double& v : row) v *= found.density;
        }
        CHECK(is_below(found.stiffness, voigt));
        CHECK(is_below(ElasticTensor{}, found.stiffness));
        const IsotropicMaterial bound = hashin_shtrikman(material, found.density),
                                closest = closest_isotropic(found.stiffness);
        CHECK(closest.bulk() < bound.bulk());
    }
}

TEST_CASE("threads change nothing, and iterations hardly grow with the resolution", "[elasticity]") {
    const IsotropicMaterial material{1, 0.3};
    HomogenizationOptions options;
    options.threads = 1;
    const ElementMask small = random_sample({16, 16, 16}, 5, 0.3),
                      large = random_sample({64, 64, 64}, 5, 0.3);
    const Homogenized one = homogenize(small, material, options), fine = homogenize(large, material);
    options.threads = 4;
    CHECK(homogenize(small, material, options).stiffness == one.stiffness);
    CHECK(fine.iterations <= one.iterations + 15);
    // Finer elements give way more.
    CHECK(closest_isotropic(fine.stiffness).young / closest_isotropic(one.stiffness).young ==
          Approx(1).margin(0.15));
}

TEST_CASE("work on a structure is told of, and can be stopped", "[elasticity]") {
    const ElementMask sample = random_sample({16, 16, 16}, 3, 0.3);
    HomogenizationOptions options;
    CancelToken cancel;
    int told = 0;
    double least = 2;
    options.on_progress = [&](int iteration, double left) {
        CHECK(iteration == told++);
        least = std::min(least, left);
    };
    homogenize(sample, {}, options);
    CHECK(told > 3);
    CHECK(least < options.tolerance);
    options.cancel = &cancel;
    options.on_progress = [&](int iteration, double) {
        if (iteration == 2) cancel.cancel();
    };
    CHECK_THROWS_AS(homogenize(sample, {}, options), Interrupted);
    // Stopped before the first iteration, it is not begun.
    told = 0;
    options.on_progress = [&](int, double) { ++told; };
    CHECK_THROWS_WITH(homogenize(sample, {}, options), Catch::Contains("stopped"));
    CHECK(told == 0);
    options.on_progress = {};
    options.cancel = nullptr;
    options.max_iterations = 2;
    CHECK_THROWS_AS(homogenize(sample, {}, options), FaultError);
}

TEST_CASE("a multigrid stops within a sweep, not at its end", "[elasticity]") {
    const ElementMask sample = random_sample({32, 32, 32}, 4, 0.4);
    const HexElement element = make_hex_element(stiffness_of({}));
    CancelToken cancel;
    ElasticMultigrid multigrid(sample, element, &cancel);
    const std::vector<float> b(multigrid.grid().nodes() * node_numbers, 1.0F);
    std::vector<float> x(b.size(), 0.0F);
    multigrid.solve(b, x);
    const auto sum_of = [](const std::vector<float>& numbers) {
        double sum = 0;
        for (const float v : numbers) sum += std::abs(v);
        return sum;
    };
    CHECK(sum_of(x) > 0);
    cancel.cancel();
    std::ranges::fill(x, 0.0F);
    CHECK_THROWS_AS(multigrid.solve(b, x), Interrupted);
    CHECK(sum_of(x) == 0);
    CHECK_THROWS_AS(ElasticMultigrid(sample, element, &cancel), Interrupted);
}

TEST_CASE("what is no sample or no material is refused", "[elasticity]") {
    const ElementMask solid = sample_of({2, 2, 2}, [](int, int, int) { return true; });
    CHECK_THROWS_AS(homogenize(sample_of({2, 2, 2}, [](int, int, int) { return false; }), {}), InputError);
    CHECK_THROWS_AS(homogenize(ElementMask{{2, 2, 3}, std::vector<std::uint8_t>(8, 1)}, {}), InputError);
    CHECK_THROWS_AS(homogenize(ElementMask{{0, 2, 2}, {}}, {}), InputError);
    CHECK_THROWS_AS(homogenize(ElementMask{{2000, 1, 1}, std::vector<std::uint8_t>(2000, 1)}, {}),
                    InputError);
    CHECK_THROWS_AS(homogenize(solid, {0, 0.3}), InputError);
    CHECK_THROWS_AS(homogenize(solid, {1, 0.5}), InputError);
    CHECK_THROWS_AS(homogenize(solid, {1, -1}), InputError);
    CHECK_THROWS_AS(homogenize(solid, {NAN, 0.3}), InputError);
}

}  // namespace homogenization_test
