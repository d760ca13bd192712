// How far balls reach on the lines about them, against roots.
#include "engine/morphology/ball_extents.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace ball_extents_test {

using namespace lamella;

namespace {

void require_reaches(const LayerLattice& lattice, double radius, int layers, int lines) {
    const double weight = radius * radius;
    const BallExtentTable reaches(lattice, weight);
    REQUIRE(reaches.are_of(weight));
    for (int z = -layers; z <= layers; ++z) {
        for (int l = -lines; l <= lines; ++l) {
            for (int i = 0; i < BallExtentTable::edge * BallExtentTable::edge; ++i) {
                const int above = i / BallExtentTable::edge, beside = i % BallExtentTable::edge;
                const double up = z + above == 0 ? 0 : (z + above) * lattice.layer_pitch;
                const double across = (l + beside) * lattice.row_pitch;
                const double left = weight - across * across - up * up;
                const std::size_t at = static_cast<std::size_t>(above) * reaches.stride() + beside;
                INFO("radius " << radius << ", " << z + above << " layers and " << l + beside
                               << " lines away");
                if (left < 0) {
                    REQUIRE(reaches.ahead(z, l)[at] == BallExtentTable::none);
                    REQUIRE(reaches.back(z, l)[at] == BallExtentTable::none);
                } else {
                    const double reach = std::sqrt(left);
                    // Ends are rounded to the nearest unit, halves upward.
                    REQUIRE(reaches.ahead(z, l)[at] == std::floor(reach + 0.5));
                    REQUIRE(-reaches.back(z, l)[at] == std::floor(-reach + 0.5));
                }
            }
        }
    }
}

}  // namespace

TEST_CASE("reaches of balls are the roots of what is left of their weight", "[morphology]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 20; ++round) {
        const LayerLattice lattice{256, round % 2 == 0 ? 256.0 : 100 + 300 * unit(random), 1};
        require_reaches(lattice, 256 * 6 * unit(random), 20, 20);
    }
    require_reaches({256, 256, 1}, 1280, 16, 16);   // lines at just the radius
    require_reaches({256, 192, 1}, 960.5, 20, 20);  // halves
    require_reaches({256, std::numeric_limits<double>::infinity(), 1}, 700, 12, 12);
    require_reaches({256, 256, 1}, 0, 12, 12);
}

TEST_CASE("balls of very many lines have no table", "[morphology]") {
    const BallExtentTable reaches({1, 1, 1}, 1e6 * 1e6);
    REQUIRE_FALSE(reaches.are_of(1e6 * 1e6));
}

}  // namespace ball_extents_test
