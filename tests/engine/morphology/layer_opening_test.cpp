// Opening and closing: what is thinner than the ball goes, what is thicker stays, and both at once never.
#include "engine/morphology/layer_opening.h"

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
    const auto opened = through(OpeningStream(lattice, 3 * run_unit), stack);
    REQUIRE(opened.size() == stack.size());
    // A block with round edges (Steiner's formula); rows and layers are a dexel apart.
    const double a = 34, c = 14, r = 3, pi = 3.14159265;
    const double round_block =
        a * a * c + 2 * r * (a * a + 2 * a * c) + pi * r * r * (2 * a + c) + 4.0 / 3 * pi * r * r * r;
    CHECK(volume(opened) == Approx(round_block).epsilon(0.03));
    CHECK(beyond(opened, stack) < 0.01 * volume(stack) / 256);
    const auto upper = std::vector<RunRows>(opened.begin() + 30, opened.end());
    CHECK(volume(upper) == 0);
    // Thin enough a ball keeps it all, but for the edges.
    CHECK(volume(through(OpeningStream(lattice, 1.4 * run_unit), stack)) ==
          Approx(volume(stack)).epsilon(0.01));
}

TEST_CASE("opening twice is opening once", "[morphology]") {
    const LayerLattice lattice{run_unit, 0.7 * run_unit, lines};
    const auto stack = dexels([](double x, double y, double z) {
        return std::sin(x / 4) + std::sin(y / 5) + std::sin(z / 6) + std::sin(x * y / 60) < 0;
    });
    for (const double radius : {1.0, 2.5, 6.2}) {
        const auto once = through(OpeningStream(lattice, radius * run_unit), stack);
        const auto twice = through(OpeningStream(lattice, radius * run_unit), once);
        CHECK(volume(once) < volume(stack));
        // Each end may be off by a unit.
        double ends = 0;
        for (const RunRows& rows : once) ends += 2 * static_cast<double>(rows.runs().size());
        CHECK(beyond(once, twice) + beyond(twice, once) <= 2 * ends / run_unit);
        CHECK(beyond(once, stack) <= 2 * ends / run_unit);
    }
}

TEST_CASE("a closing fills what is narrower than the ball, and reaches over no border", "[morphology]") {
    const LayerLattice lattice{run_unit, run_unit, lines};
    // Two blocks that fill the lattice but for a slit 4 wide and a shaft 20 wide.
    const auto stack = dexels([](double x, double y, double) {
        const bool slit = 20 <= x && x < 24, shaft = distance(x - 45, y - 30, 0) < 10;
        return !slit && !shaft;
    });
    const auto closed = through(ClosingStream(lattice, 3 * run_unit), stack);
    REQUIRE(closed.size() == stack.size());
    CHECK(beyond(stack, closed) == 0);
    const double shaft = 3.14159265 * 100 * layers;
    // The slit is open at both ends, where balls enter by less than their radius.
    CHECK(volume(closed) == Approx(60.0 * lines * layers - shaft).epsilon(0.006));
    CHECK(volume(through(ClosingStream(lattice, 1.9 * run_unit), stack)) ==
          Approx(volume(stack)).epsilon(1e-3));
}

TEST_CASE("opening and closing are each other's mirror", "[morphology]") {
    const LayerLattice lattice{run_unit, run_unit, lines};
    const auto inside = [](double v) { return 14 <= v && v < 46; };
    const Solid wavy = [](double x, double y, double z) {
        return std::sin(x / 3) * std::cos(y / 4) + std::sin(z / 3) + std::cos(x * z / 80) < 0.2;
    };
    const double radius = 2.3;
    const auto solid = dexels(
        [&](double x, double y, double z) { return inside(x) && inside(y) && inside(z) && wavy(x, y, z); });
    const auto void_in_box = dexels([&](double x, double y, double z) {
        return !(inside(x) && inside(y) && inside(z) && wavy(x, y, z)) && 1 <= x && x < 59;
    });
    const auto closed = through(ClosingStream(lattice, radius * run_unit), solid);
    const auto opened = through(OpeningStream(lattice, radius * run_unit), void_in_box);
    // Far from the lattice's border what is not in the one is in the other, to a unit an end.
    double both = 0, neither = 0, ends = 0;
    for (std::size_t z = 10; z < 50; ++z) {
        for (std::size_t y = 10; y < 50; ++y) {
            std::int64_t filled = 0;
            RunRows a, b, common;
            a.append_line(closed[z].line(y));
            b.append_line(opened[z].line(y));
            intersect(a, b, common);
            filled = a.total_length() + b.total_length() - common.total_length();
            both += static_cast<double>(common.total_length());
            neither += static_cast<double>(58 * run_unit - filled);
            ends += 2 * static_cast<double>(a.runs().size() + b.runs().size());
        }
    }
    CHECK(both <= ends);
    CHECK(neither <= ends + 40.0 * 40 * 2 * run_unit);
}

}  // namespace layer_opening_test
