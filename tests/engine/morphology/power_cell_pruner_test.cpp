// Runs out of whose sight a line lies add nothing to it: against the union of all runs, and of all but these.
#include "engine/morphology/power_cell_pruner.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/runs/run_union.h"

namespace power_cell_pruner_test {

using namespace lamella;

namespace {

using Stack = std::vector<WeightedRows>;

/// Slanted struts, specks and slabs, as in a foam.
Stack random_stack(std::mt19937& random, int layers, int lines, double radius, bool varying) {
    std::uniform_real_distribution<double> unit(0, 1);
    Stack stack;
    for (int z = 0; z < layers; ++z) {
        WeightedRows& rows = stack.emplace_back();
        for (int l = 0; l < lines; ++l) {
            std::vector<WeightedRun> runs;
            std::int32_t end = 0;
            for (int i = 0; i < 5; ++i) {
                const double around = 3 - std::hypot((l * 3 + i * 7) % 11 - 5, (z * 2 + i * 5) % 13 - 6);
                if (around <= 0 && unit(random) < 0.8) continue;
                const auto middle = static_cast<std::int32_t>(1500 * i + 90 * l + 60 * z + 50 * unit(random));
                const auto half = static_cast<std::int32_t>(20 + 200 * std::max(around, 0.1));
                const std::int32_t begin = std::max(middle - half, end + 1);
                if (begin >= middle + half) continue;
                end = middle + half;
                const double r = varying ? radius * (0.4 + 0.6 * unit(random)) : radius;
                runs.push_back({begin, end, r * r});
            }
            rows.append_line(runs);
        }
    }
    return stack;
}

struct Grown {
    std::vector<Run> of_all, of_seen;
    std::size_t runs = 0, unseen = 0;
};

Grown grow_line(const Stack& stack, const LayerLattice& lattice, int z, int l) {
    RunUnion all({-30000, 40000}), seen({-30000, 40000});
    Grown grown;
    for (int from_z = 0; from_z < static_cast<int>(stack.size()); ++from_z) {
        const WeightedRows& rows = stack[static_cast<std::size_t>(from_z)];
        for (std::size_t i = 0; i < rows.runs().size(); ++i) {
            const WeightedRun& run = rows.runs()[i];
            const int lines = l - rows.lines_of_runs()[i], layers = z - from_z;
            const double across = lines * lattice.row_pitch, up = layers * lattice.layer_pitch;
            const double left = run.weight - across * across - up * up;
            if (left < 0) continue;
            const RoundedExtent reach(std::sqrt(left));
            all.add(run.begin - reach.back, run.end + reach.ahead);
            ++grown.runs;
            if (rows.sights()[i].reaches(BlockOffset(Neighbor::line_before, -lines) |
                                         BlockOffset(Neighbor::line_behind, lines) |
                                         BlockOffset(Neighbor::layer_below, -layers) |
                                         BlockOffset(Neighbor::layer_above, layers))) {
                seen.add(run.begin - reach.back, run.end + reach.ahead);
            } else {
                ++grown.unseen;
            }
        }
    }
    all.take(grown.of_all);
    seen.take(grown.of_seen);
    return grown;
}

}  // namespace

TEST_CASE("what is out of sight adds nothing to a line", "[morphology]") {
    std::mt19937 random(11);
    constexpr int size = 22;
    for (int round = 0; round < 12; ++round) {
        const double radius = run_unit * (2 + round);
        const LayerLattice lattice{round % 3 == 0 ? 190.25 : 256, round % 4 < 2 ? 256.0 : 0.5, size};
        Stack stack = random_stack(random, size, size, radius, round % 2 == 1);
        const PowerCellPruner limits(lattice, radius * radius);
        for (WeightedRows& rows : stack) {
            rows.begin_sights();
            limits.limit(rows);
        }
        for (std::size_t z = 1; z < stack.size(); ++z) limits.limit(stack[z - 1], stack[z], 0, size);
        std::size_t runs = 0, unseen = 0;
        for (int z = 0; z < size; z += 3) {
            for (int l = 0; l < size; ++l) {
                CAPTURE(round, z, l);
                const Grown grown = grow_line(stack, lattice, z, l);
                REQUIRE(grown.of_seen == grown.of_all);
                runs += grown.runs;
                unseen += grown.unseen;
            }
        }
        CAPTURE(round, runs, unseen);
        CHECK(unseen > runs / 20);
    }
}

TEST_CASE("sight ends where a ball on the next line reaches as far", "[morphology]") {
    // One run a line, its end one pitch back from line to line: the surface leans by 45 degrees.
    const double radius = 10 * run_unit;
    const LayerLattice lattice{run_unit, run_unit, 30};
    WeightedRows rows;
    for (std::int32_t l = 0; l < 30; ++l) {
        const WeightedRun run{-20000, -l * run_unit, radius * radius};
        rows.append_line(std::span(&run, 1));
    }
    rows.begin_sights();
    PowerCellPruner(lattice, radius * radius).limit(rows);
    // d lines away both reach as far where 2 d - 1 = 2 sqrt(100 - d^2) + 1 in pitches: d = 7.55.
    const PowerCellBounds sight = rows.sights()[10];
    CHECK(sight.reaches(BlockOffset(Neighbor::line_behind, 7)));
    CHECK_FALSE(sight.reaches(BlockOffset(Neighbor::line_behind, 8)));
    CHECK(sight.reaches(BlockOffset(Neighbor::line_behind, 0)));
    CHECK_FALSE(sight.reaches(BlockOffset(Neighbor::line_before, 1)));
    CHECK(sight.reaches(BlockOffset(Neighbor::layer_above, 126)));
}

}  // namespace power_cell_pruner_test
