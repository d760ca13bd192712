// Cavities from layer to layer: what is solid above is held, by brute force; hip roofs and walls.
#include "engine/surveys/printable_roof.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/engine/morphology/bonding.h"

namespace printable_roof_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr int lines = 64;

/// Discs at random, each there over some layers.
std::vector<RunRows> blobs(unsigned seed, int layers) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(12, 52), radius(3, 14), height(0, layers);
    struct Disc {
        double x, y, r, from, to;
    };
    std::vector<Disc> discs;
    for (int k = 0; k < 12; ++k) {
        const double from = height(random), to = height(random);
        discs.push_back(
            {place(random), place(random), radius(random), std::min(from, to), std::max(from, to)});
    }
    std::vector<RunRows> stack;
    for (int z = 0; z < layers; ++z) {
        stack.push_back(rows_where(lines, 64, [&](double x, double y) {
            for (const Disc& d : discs) {
                if (d.from <= z && z < d.to && std::hypot(x - d.x, y - d.y) < d.r) return true;
            }
            return false;
        }));
    }
    return stack;
}

RunRows nothing() {
    RunRows rows;
    for (int l = 0; l < lines; ++l) rows.end_line();
    return rows;
}

std::vector<RunRows> cavities(const std::vector<RunRows>& insides, const RoofRule& rule) {
    std::vector<RunRows> stack(insides.size());
    RunRows above = nothing();
    for (std::size_t i = insides.size(); i-- > 0;) stack[i] = above = cavity_below(above, insides[i], rule);
    return stack;
}

bool within(const RunRows& a, const RunRows& b) {
    RunRows rest;
    subtract(a, b, rest);
    return rest.runs().empty();
}

}  // namespace

TEST_CASE("what is solid over a cavity is within a step of solid, whatever the inside is", "[enclosure]") {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
        for (const double step : {2.0, 3.4}) {
            INFO("seed " << seed << ", step " << step);
            const auto insides = blobs(seed, 30);
            const RoofRule rule{step * run_unit, run_unit, 2 * run_unit};
            const auto stack = cavities(insides, rule);
            std::int64_t inside = 0, hollow = 0;
            for (std::size_t i = 0; i < stack.size(); ++i) {
                REQUIRE(within(stack[i], insides[i]));
                const RunRows above = i + 1 < stack.size() ? stack[i + 1] : nothing();
                REQUIRE(furthest_overhang(stack[i], above, run_unit) <= step * run_unit + 1);
                inside += insides[i].total_length();
                hollow += stack[i].total_length();
            }
            // A roof that closes at once would leave nothing; one that never does, everything.
            REQUIRE(hollow > inside / 5);
            REQUIRE(hollow < inside);
        }
    }
}

TEST_CASE("under a flat ceiling a hip roof rises by a step from all sides at once", "[enclosure]") {
    const auto rectangle = [](double shrunk) {
        return rows_where(lines, 64, [&](double x, double y) {
            return 8 + shrunk <= x && x < 56 - shrunk && 20 + shrunk <= y && y < 44 - shrunk;
        });
    };
    const auto stack = cavities(std::vector<RunRows>(10, rectangle(0)), {2.0 * run_unit, run_unit, 0});
    for (int depth = 0; depth < 10; ++depth) {
        // The inside is 24 wide: twelve less two a layer, as far as the search for it goes.
        const double shrunk = std::max(0.0, 12 - 2.0 * (depth + 1));
        const RunRows& rows = stack[static_cast<std::size_t>(9 - depth)];
        REQUIRE(within(rectangle(shrunk + 1.2), rows));
        REQUIRE(within(rows, rectangle(std::max(0.0, shrunk - 1.2))));
    }
}

TEST_CASE("an inside that leans in by no more than a step is hollow wholly", "[enclosure]") {
    std::vector<RunRows> insides;
    for (int z = 0; z < 14; ++z) {
        insides.push_back(rows_where(
            lines, 64, [&](double x, double y) { return std::hypot(x - 32, y - 32) < 24 - 1.8 * z; }));
    }
    const auto stack = cavities(insides, {2.0 * run_unit, run_unit, 0});
    for (std::size_t i = 0; i < stack.size(); ++i) {
        // Rows are taken for what is between them: slivers where they graze a disc may be lost.
        RunRows lost;
        subtract(insides[i], stack[i], lost);
        REQUIRE(lost.total_length() * 500 < insides[i].total_length());
        for (const Run& run : lost.runs()) REQUIRE(run.end - run.begin < run_unit / 2);
    }
}

TEST_CASE("a wall between cavities that meet is no thinner than asked for, and torn where it may be",
          "[enclosure]") {
    // Two shafts from above open into one wide room: the solid between them hangs in it.
    const RunRows room =
        rows_where(lines, 64, [](double x, double y) { return 4 <= x && x < 60 && 12 <= y && y < 52; });
    const double least = 3;
    RunRows above = rows_where(lines, 64, [](double x, double y) {
        return ((4 <= x && x < 22) || (42 <= x && x < 60)) && 12 <= y && y < 52;
    });
    for (int z = 0; z < 24; ++z) {
        const RunRows below = cavity_below(above, room, {2.0 * run_unit, run_unit, least * run_unit});
        REQUIRE(furthest_overhang(below, above, run_unit) <= 2 * run_unit + 1);
        REQUIRE(within(above, below));
        above = below;
        // Beside the room's border, where no gap has come to yet.
        const auto runs = above.line(14);
        if (z < 6) {
            REQUIRE(runs.size() == 2);
            REQUIRE(runs[1].begin - runs[0].end >= least * run_unit);
        }
    }
    REQUIRE(above == room);
}

}  // namespace printable_roof_test
