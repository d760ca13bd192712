// Enclosures: they hold what they must, their outlines bond by brute force, and no place is there for
// nothing.
#include "engine/surveys/printable_enclosure.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "tests/engine/morphology/bonding.h"

namespace printable_enclosure_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr int lines = 48;
constexpr std::size_t plenty = 100'000'000;
constexpr double step = 2.0 * run_unit, corner = 1.6 * step;

using Stack = std::vector<RunRows>;

/// Balls of at least `least` pixels at random.
Stack balls(unsigned seed, int layers, int count, double least) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(12, 36), radius(least, 9), height(0, layers);
    struct Ball {
        double x, y, z, r;
    };
    std::vector<Ball> all;
    for (int k = 0; k < count; ++k)
        all.push_back({place(random), place(random), height(random), radius(random)});
    Stack stack;
    for (int z = 0; z < layers; ++z) {
        stack.push_back(rows_where(lines, 48, [&](double x, double y) {
            for (const Ball& b : all) {
                if (std::hypot(x - b.x, y - b.y, z - b.z) < b.r) return true;
            }
            return false;
        }));
    }
    return stack;
}

LayerStack kept(const Stack& stack) {
    LayerStack layers(plenty, 0.1);
    for (const RunRows& rows : stack) layers.push(rows);
    return layers;
}

bool within(const RunRows& a, const RunRows& b) {
    RunRows rest;
    subtract(a, b, rest);
    return rest.runs().empty();
}

/// Contains the stack; the outlines of neighbours are near each other.
void check_bonds(const Stack& stack, const LayerStack& layers) {
    REQUIRE(layers.size() == stack.size());
    for (std::size_t i = 0; i < stack.size(); ++i) REQUIRE(within(stack[i], layers[i]));
    for (std::size_t i = 1; i < stack.size(); ++i) {
        INFO("layer " << i);
        REQUIRE(furthest_overhang(layers[i], layers[i - 1], run_unit) <= step + 1);
        REQUIRE(furthest_overhang(layers[i - 1], layers[i], run_unit) <= step + 1);
        REQUIRE(furthest_from(layers[i], layers[i - 1], run_unit) <= corner + run_unit / 2 + 1);
    }
}

/// Distance from a place to the nearest outside the rows, beyond which all is outside.
double depth(const RunRows& rows, int l, std::int32_t u) {
    double nearest = infinity;
    for (int k = -1; k <= lines; ++k) {
        const bool beyond = k < 0 || k >= lines;
        const double along = beyond ? 0 : way_out(rows.line(static_cast<std::size_t>(k)), u);
        nearest = std::min(nearest, std::hypot(along, (k - l) * static_cast<double>(run_unit)));
    }
    return nearest;
}

/// Places that could be taken away without leaving anything of a neighbour further than a step inside; all
/// that were looked at.
struct Spare {
    int places = 0, all = 0;
};

Spare spare_places(const Stack& stack, const LayerStack& layers) {
    Spare spare;
    for (std::size_t i = 0; i < stack.size(); ++i) {
        RunRows added;
        subtract(layers[i], stack[i], added);
        for (int l = 0; l < lines; ++l) {
            for (const Run& run : added.line(static_cast<std::size_t>(l))) {
                for (std::int32_t u = run.begin; u < run.end; u += 5) {
                    const bool above = i + 1 < stack.size() && depth(layers[i + 1], l, u) >= step - 1;
                    const bool below = i > 0 && depth(layers[i - 1], l, u) >= step - 1;
                    ++spare.all;
                    spare.places += above || below ? 0 : 1;
                }
            }
        }
    }
    return spare;
}

}  // namespace

TEST_CASE("an enclosure holds what it must, and neighbours' outlines lie within a step", "[enclosure]") {
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
        INFO("seed " << seed);
        const Stack stack = balls(seed, 30, 6, 1);
        LayerStack layers = kept(stack);
        enclose(layers, {step, corner, run_unit}, nullptr);
        check_bonds(stack, layers);
        // Where something stands, something stands down to the lowest layer.
        bool begun = false;
        for (std::size_t i = stack.size(); i-- > 0;) {
            begun = begun || !layers[i].runs().empty();
            REQUIRE(layers[i].runs().empty() != begun);
        }
        // And it changes no more.
        const LayerStack before = layers;
        REQUIRE(enclose(layers, {step, corner, run_unit}, nullptr) == 2);
        for (std::size_t i = 0; i < layers.size(); ++i) REQUIRE(layers[i] == before[i]);
    }
}

TEST_CASE("no place of an enclosure can be left out", "[enclosure]") {
    // Columns that stand on the lowest layer and have no thin ends: what is added, the first condition alone
    // asks for.
    Stack stack;
    for (int z = 0; z < 20; ++z) {
        stack.push_back(rows_where(lines, 48, [&](double x, double y) {
            const bool stem = std::hypot(x - 24, y - 22) < 8;
            const bool cap = z >= 12 && std::hypot(x - 22, y - 24) < 19;
            const bool base = z < 4 && 8 <= x && x < 40 && 10 <= y && y < 30;
            return stem || cap || base;
        }));
    }
    LayerStack layers = kept(stack);
    enclose(layers, {step, corner, run_unit}, nullptr);
    check_bonds(stack, layers);
    const Spare spare = spare_places(stack, layers);
    REQUIRE(spare.all > 10000);
    REQUIRE(spare.places == 0);
}

TEST_CASE("what begins in the air tapers off below, to a thin pillar", "[enclosure]") {
    constexpr int count = 16;
    const auto bottom_of = [](auto shape, auto check) {
        Stack stack(count - 1, rows_where(lines, 48, [](double, double) { return false; }));
        stack.push_back(rows_where(lines, 48, shape));
        LayerStack layers = kept(stack);
        enclose(layers, {step, corner, run_unit}, nullptr);
        check_bonds(stack, layers);
        for (int below = 0; below < count; ++below) {
            const RunRows& rows = layers[static_cast<std::size_t>(count - 1 - below)];
            check(below, static_cast<double>(rows.total_length()) / run_unit);
        }
    };
    // Two a layer off the radius; what is thinner than a step to all sides stays.
    bottom_of([](double x, double y) { return std::hypot(x - 24, y - 24) < 14.2; },
              [](int below, double area) {
                  const double r = std::max(14.2 - 2.0 * below, 0.0);
                  if (r > 4) REQUIRE(area <= 3.14159265 * (r + 0.5) * (r + 0.5));  // half a row
                  REQUIRE(area > 0);
                  REQUIRE(area >= 3.14159265 * r * r * 0.96);
                  if (r == 0) REQUIRE(area < 16);
              });
    // Right angles are drawn in with their sides.
    bottom_of([](double x, double y) { return 14 <= x && x < 34 && 14 <= y && y < 34; },
              [](int below, double area) {
                  const double width = std::max(20 - 4.0 * below, 0.0);
                  REQUIRE(area >= width * width * 0.98);
                  if (width > 4) REQUIRE(area <= width * width * 1.02);
                  if (width < 4) REQUIRE(area <= 16);
                  REQUIRE(area > 0);
              });
}

TEST_CASE("what ends below the top closes as a roof", "[enclosure]") {
    Stack stack;
    for (int z = 0; z < 12; ++z) {
        stack.push_back(rows_where(
            lines, 48, [&](double x, double y) { return z < 3 && 10 <= x && x < 34 && 10 <= y && y < 34; }));
    }
    LayerStack layers = kept(stack);
    enclose(layers, {step, corner, run_unit}, nullptr);
    check_bonds(stack, layers);
    for (int above = 0; above < 9; ++above) {
        const double width = std::max(0.0, 24 - 4.0 * above);
        const auto length = static_cast<double>(layers[static_cast<std::size_t>(2 + above)].total_length());
        REQUIRE(length / run_unit == Approx(width * width).epsilon(0.02));
    }
}

TEST_CASE("an enclosure has no more room than it is given, and stops when told to", "[enclosure]") {
    LayerStack small(30000, 0.1);
    const Stack stack = balls(1, 30, 6, 1);
    REQUIRE_THROWS_AS(
        [&] {
            for (const RunRows& rows : stack) small.push(rows);
        }(),
        InputError);
    LayerStack layers = kept(stack);
    CancelToken cancel;
    cancel.cancel();
    REQUIRE_THROWS_AS(enclose(layers, {step, corner, run_unit}, &cancel), Interrupted);
}

}  // namespace printable_enclosure_test
