// Erosion, then dilation, which is an opening: drops walls thinner than the ball and keeps thicker ones.
#include "engine/morphology/layer_offset.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/engine/morphology/through_layers.h"

namespace layer_opening_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr std::size_t lines = 60;
constexpr int layers = 60;
using Solid = std::function<bool(double x, double y, double z)>;  // dexels

/// Sampled along lines at a sixteenth of a dexel.
std::vector<RunRows> dexels(const Solid& solid) {
    std::vector<RunRows> stack;
    for (int z = 0; z < layers; ++z) {
        RunRows rows;
        for (std::size_t y = 0; y < lines; ++y) {
            for (int x = 0; x < 60 * 16; ++x) {
                if (solid((x + 0.5) / 16, static_cast<double>(y), z)) rows.push(x * 16, x * 16 + 16);
            }
            rows.end_line();
        }
        stack.push_back(rows);
    }
    return stack;
}

double volume(const std::vector<RunRows>& stack) {
    double sum = 0;
    for (const RunRows& rows : stack) sum += static_cast<double>(rows.total_length()) / run_unit;
    return sum;
}

/// What of a is not in b, dexels.
double beyond(const std::vector<RunRows>& a, const std::vector<RunRows>& b) {
    double sum = 0;
    RunRows rest;
    for (std::size_t i = 0; i < a.size(); ++i) {
        subtract(a[i], b[i], rest);
        sum += static_cast<double>(rest.total_length()) / run_unit;
    }
    return sum;
}

/// The union of all balls within the solid.
std::vector<RunRows> opened(const std::vector<RunRows>& stack, const LayerLattice& lattice, double radius) {
    const auto eroded = through(ErosionStream(lattice, radius), stack);
    return through(DilationStream(lattice, radius), eroded,
                   [&](const RunRows& rows) { return WeightedRows(rows, radius); });
}

bool plate(double z, double from, double to) { return from <= z && z < to; }
double distance(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

}  // namespace

TEST_CASE("an opening drops what is thinner than the ball and keeps the rest", "[morphology]") {
    const LayerLattice lattice{run_unit, run_unit, lines};
    // A block 20 thick with a fin 4 thick on top, a speck beside it.
    const auto block = [](double x, double y, double z) {
        return 10 <= x && x < 50 && plate(y, 10, 50) && plate(z, 5, 25);
    };
    const auto stack = dexels([&](double x, double y, double z) {
        const bool fin = 28 <= x && x < 32 && plate(y, 10, 50) && plate(z, 25, 50);
        return block(x, y, z) || fin || distance(x - 5, y - 5, z - 40) < 2;
    });
    const auto rounded = opened(stack, lattice, 3 * run_unit);
    REQUIRE(rounded.size() == stack.size());
    // A block with round edges (Steiner's formula); rows and layers are a dexel apart.
    const double a = 34, c = 14, r = 3, pi = 3.14159265;
    const double round_block =
        a * a * c + 2 * r * (a * a + 2 * a * c) + pi * r * r * (2 * a + c) + 4.0 / 3 * pi * r * r * r;
    CHECK(volume(rounded) == Approx(round_block).epsilon(0.03));
    CHECK(beyond(rounded, stack) < 0.01 * volume(stack) / 256);
    const auto upper = std::vector<RunRows>(rounded.begin() + 30, rounded.end());
    CHECK(volume(upper) == 0);
    // Thin enough a ball keeps it all, but for the edges.
    CHECK(volume(opened(stack, lattice, 1.4 * run_unit)) == Approx(volume(stack)).epsilon(0.01));
}

TEST_CASE("opening twice is opening once", "[morphology]") {
    const LayerLattice lattice{run_unit, 0.7 * run_unit, lines};
    const auto stack = dexels([](double x, double y, double z) {
        return std::sin(x / 4) + std::sin(y / 5) + std::sin(z / 6) + std::sin(x * y / 60) < 0;
    });
    for (const double radius : {1.0, 2.5, 6.2}) {
        const auto once = opened(stack, lattice, radius * run_unit);
        const auto twice = opened(once, lattice, radius * run_unit);
        CHECK(volume(once) < volume(stack));
        // Each end may be off by a unit.
        double ends = 0;
        for (const RunRows& rows : once) ends += 2 * static_cast<double>(rows.runs().size());
        CHECK(beyond(once, twice) + beyond(twice, once) <= 2 * ends / run_unit);
        CHECK(beyond(once, stack) <= 2 * ends / run_unit);
    }
}

}  // namespace layer_opening_test
