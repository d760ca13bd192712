// Shapes of densities: levels, volumes, refined grids and pieces, against closed forms.
#include "procedural/optimization/density_shape.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace density_shape_test {

using namespace lamella;

namespace {

/// A grid of free elements with densities by their centres, in elements.
template <typename Density>
DensityGrid grid_of(glm::ivec3 size, const Density& density) {
    DensityGrid grid{size, {}, {}};
    const std::size_t count = grid.place({0, 0, size.z});
    grid.use.assign(count, ElementUse::free);
    for (std::size_t i = 0; i < count; ++i) grid.density.push_back(density(dvec3(grid.element(i)) + 0.5));
    return grid;
}

}  // namespace

TEST_CASE("a refined grid has the trilinear densities, and coarsens to its means", "[optimization]") {
    const auto plane = [](dvec3 p) { return 0.1 + 0.02 * p.x + 0.03 * p.y + 0.01 * p.z; };
    const DensityGrid grid = grid_of({6, 5, 4}, plane);
    for (const int factor : {1, 2, 3, 4}) {
        const DensityGrid fine = refined(grid, factor);
        REQUIRE(fine.size == factor * grid.size);
        for (std::size_t i = 0; i < fine.density.size(); ++i) {
            // Beyond the outermost centres densities are constant.
            const dvec3 p = (dvec3(fine.element(i)) + 0.5) / static_cast<double>(factor);
            const dvec3 inside = glm::clamp(p, dvec3(0.5), dvec3(grid.size) - 0.5);
            CHECK(fine.density[i] == Approx(plane(inside)).epsilon(1e-12));
        }
        const std::vector<double> means = coarsened(fine.density, grid.size, factor);
        REQUIRE(means.size() == grid.density.size());
        for (std::size_t i = 0; i < means.size(); ++i) {
            const glm::ivec3 at = grid.element(i);
            const bool inner = glm::clamp(at, glm::ivec3(1), grid.size - 2) == at;
            if (inner) CHECK(means[i] == Approx(grid.density[i]).epsilon(1e-12));
        }
    }
    const DensityGrid flat = refined(grid_of({4, 3, 1}, plane), 3);
    CHECK(flat.size == glm::ivec3(12, 9, 1));
}

TEST_CASE("cubics refine quadratic densities exactly, and stay from 0 to 1", "[optimization]") {
    const auto quadratic = [](dvec3 p) {
        return 0.45 + 0.005 * p.x * p.x - 0.01 * p.y * p.y + 0.0075 * p.x * p.z + 0.01 * p.z;
    };
    const DensityGrid grid = grid_of({7, 6, 5}, quadratic);
    const DensityGrid fine = refined(grid, 3, Interpolation::cubic);
    REQUIRE(fine.size == 3 * grid.size);
    int inner = 0;
    for (std::size_t i = 0; i < fine.density.size(); ++i) {
        const dvec3 p = (dvec3(fine.element(i)) + 0.5) / 3.0;
        if (glm::clamp(p, dvec3(1.5), dvec3(grid.size) - 1.5) != p) continue;
        ++inner;
        CHECK(fine.density[i] == Approx(quadratic(p)).epsilon(1e-12));
    }
    CHECK(inner == 13 * 10 * 7);
    // Cubics shoot beyond a step.
    const DensityGrid step =
        refined(grid_of({8, 4, 1}, [](dvec3 p) { return p.x > 4; }), 4, Interpolation::cubic);
    CHECK(*std::ranges::max_element(step.density) == 1);
    CHECK(*std::ranges::min_element(step.density) == 0);
}

TEST_CASE("parts of an element have its use", "[optimization]") {
    DensityGrid grid = grid_of({3, 2, 2}, [](dvec3) { return 0.5; });
    grid.use[grid.place({2, 1, 0})] = ElementUse::solid;
    const DensityGrid fine = refined(grid, 2);
    int solid = 0;
    for (std::size_t i = 0; i < fine.use.size(); ++i) {
        if (fine.use[i] != ElementUse::solid) continue;
        ++solid;
        CHECK(fine.element(i) / 2 == glm::ivec3(2, 1, 0));
    }
    CHECK(solid == 8);
}

TEST_CASE("the level keeps the volume of a ball", "[optimization]") {
    const DensityGrid grid =
        grid_of({24, 24, 24}, [](dvec3 p) { return std::max(0.0, 1 - glm::distance(p, dvec3(12)) / 16); });
    for (const double share : {0.1, 0.3, 0.5}) {
        const double level = volume_keeping_level(grid, share);
        CHECK(solid_volume(grid, level) == Approx(share).epsilon(0.002));
        // The radius of a ball of that volume.
        const double radius = std::cbrt(share * 24 * 24 * 24 * 3 / (4 * M_PI));
        CHECK(level == Approx(1 - radius / 16).epsilon(0.01));
    }
}

TEST_CASE("pieces that are not held or not loaded are emptied", "[optimization]") {
    DensityGrid grid = grid_of({9, 3, 1}, [](dvec3 p) { return std::fmod(p.x, 3) < 2 ? 0.9 : 0.0; });
    std::vector<std::uint8_t> anchored(27), loaded(27);
    anchored[grid.place({0, 0, 0})] = anchored[grid.place({3, 0, 0})] = 1;
    loaded[grid.place({0, 2, 0})] = loaded[grid.place({6, 0, 0})] = 1;
    const StrayPieces stray = drop_stray_pieces(grid, 0.5, anchored, loaded);
    CHECK(stray.pieces == 2);
    CHECK(stray.elements == 12);
    for (int x = 0; x < 9; ++x) CHECK((grid.density[grid.place({x, 1, 0})] > 0.5) == (x < 2));
}

}  // namespace density_shape_test
