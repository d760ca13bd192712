// Shapes without overhangs, against cones in closed form and by brute force between the layers of elements.
#include "procedural/optimization/overhang_shape.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace overhang_shape_test {

using namespace lamella;

namespace {

template <typename Solid>
DensityGrid shape_of(glm::ivec3 size, const Solid& solid) {
    DensityGrid grid{size, {}, {}};
    const std::size_t count = grid.place({0, 0, size.z});
    grid.use.assign(count, ElementUse::free);
    for (std::size_t i = 0; i < count; ++i)
        grid.density.push_back(solid(dvec3(grid.element(i)) + 0.5) ? 1 : 0);
    return grid;
}

/// The trilinear density at a place in elements.
double density_at(const DensityGrid& grid, dvec3 p) {
    const dvec3 q = glm::clamp(p - 0.5, dvec3(0), dvec3(grid.size - 1));
    const glm::ivec3 first = glm::min(glm::ivec3(q), glm::max(grid.size - 2, glm::ivec3(0)));
    const dvec3 way = q - dvec3(first);
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        const glm::ivec3 up(c & 1, c >> 1 & 1, c >> 2 & 1);
        const dvec3 share = glm::mix(1.0 - way, way, dvec3(up));
        sum += share.x * share.y * share.z * grid.density[grid.place(glm::min(first + up, grid.size - 1))];
    }
    return sum;
}

/// The largest distance in the plane from a solid point to the solid of the height `drop` below it, in
/// elements; both sampled `per_element` times an element.
double largest_overhang(const DensityGrid& grid, double level, double drop, int per_element) {
    const double pitch = 1.0 / per_element;
    const int width = grid.size.x * per_element, height = grid.size.y * per_element;
    constexpr int reach = 12;  // samples
    double largest = 0;
    for (double z = 1; z < grid.size.z; z += drop) {
        const auto solid = [&](int x, int y, double at) {
            return density_at(grid, {(x + 0.5) * pitch, (y + 0.5) * pitch, at}) > level;
        };
        std::vector<std::uint8_t> below(static_cast<std::size_t>(width * height));
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x)
                below[static_cast<std::size_t>(y * width + x)] = solid(x, y, z - drop);
        }
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (below[static_cast<std::size_t>(y * width + x)] != 0 || !solid(x, y, z)) continue;
                double nearest = reach;
                for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
                    for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u) {
                        if (below[static_cast<std::size_t>(v * width + u)] != 0)
                            nearest = std::min(nearest, std::hypot(u - x, v - y));
                    }
                }
                largest = std::max(largest, nearest * pitch);
            }
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("a mushroom's cap becomes the cone that its stem can bear", "[optimization]") {
    // A stem of radius 3, and from z = 6 on a cap over everything.
    const DensityGrid grid =
        shape_of({33, 33, 16}, [](dvec3 p) { return std::hypot(p.x - 16.5, p.y - 16.5) < 3 || p.z > 6; });
    const DensityGrid limited = with_limited_overhang(grid, 1, 1);
    for (const double z : {9.5, 11.5, 13.5}) {
        for (const double angle : {0.0, 0.4, 0.8}) {
            double radius = 0;
            while (radius < 16 &&
                   density_at(limited, dvec3(16.5, 16.5, z) +
                                           radius * dvec3(std::cos(angle), std::sin(angle), 0)) > 0.5)
                radius += 0.02;
            // The cap's lowest layer is that above 6, one element above the last of the stem.
            CHECK(radius == Approx(3 + z - 5.5).margin(0.75));
        }
    }
}

TEST_CASE("shapes at any level stand out by the slope at most, between layers as well", "[optimization]") {
    std::mt19937 random(7);
    for (int round = 0; round < 3; ++round) {
        std::vector<dvec3> balls;
        for (int i = 0; i < 12; ++i) balls.emplace_back(random() % 24, random() % 24, random() % 18);
        const DensityGrid grid = shape_of({24, 24, 18}, [&](dvec3 p) {
            bool solid = p.z < 1;
            for (const dvec3 b : balls) {
                solid = solid || std::hypot(p.x - b.x, p.y - b.y) < (p.z < b.z ? 1.5 : 0) ||
                        glm::distance(p, b) < 4;
            }
            return solid;
        });
        const DensityGrid limited = with_limited_overhang(grid, 0.3, 3);
        REQUIRE(limited.size == glm::ivec3(72, 72, 54));
        CHECK(solid_volume(limited, 0.5) == Approx(0.3).epsilon(0.1));
        // Samples a third of an element apart; where members meet above a gap, trilinear values are right
        // to half an element.
        constexpr double drop = 2.0 / 3;
        CHECK(largest_overhang(refined(grid, 3), 0.5, drop, 1) > 2.5);
        const double level = 0.45 + 0.05 * round;
        CAPTURE(round, level);
        const double largest = largest_overhang(limited, level, drop, 3);
        CHECK(largest < drop + 0.6);
        CHECK(largest > 0.5 * drop);
    }
}

TEST_CASE("prescribed solid elements stay where nothing bears them", "[optimization]") {
    DensityGrid grid = shape_of({12, 12, 10}, [](dvec3 p) { return p.z < 2; });
    for (int y = 4; y < 8; ++y) {
        for (int x = 4; x < 8; ++x) {
            for (int z = 6; z < 9; ++z) {
                grid.use[grid.place({x, y, z})] = ElementUse::solid;
                grid.density[grid.place({x, y, z})] = 1;
            }
        }
    }
    const DensityGrid limited = with_limited_overhang(grid, 0.3, 2);
    CHECK(density_at(limited, 2.0 * dvec3(6, 6, 7.5)) > 0.5);
    CHECK(density_at(limited, 2.0 * dvec3(6, 6, 4)) < 0.5);
}

}  // namespace overhang_shape_test
