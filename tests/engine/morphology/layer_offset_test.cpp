// Offsets of dexel solids against brute force: every line grown by what every line in reach gives it.
#include "engine/morphology/layer_offset.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "engine/morphology/dilated_difference.h"
#include "tests/engine/morphology/through_layers.h"

namespace layer_offset_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr std::int32_t far = 1 << 29;
using Lines = std::vector<std::vector<WeightedRun>>;
using Stack = std::vector<Lines>;  // layer by layer

std::vector<Run> united(std::vector<Run> runs) {
    std::sort(runs.begin(), runs.end(), [](Run a, Run b) { return a.begin < b.begin; });
    std::vector<Run> result;
    for (const Run run : runs) {
        if (run.begin >= run.end) continue;
        if (!result.empty() && run.begin <= result.back().end)
            result.back().end = std::max(result.back().end, run.end);
        else
            result.push_back(run);
    }
    return result;
}

/// Line l of layer z, grown by all lines of all layers.
std::vector<Run> grown_line(const Stack& stack, const LayerLattice& lattice, int z, int l) {
    std::vector<Run> runs;
    for (int from_z = 0; from_z < static_cast<int>(stack.size()); ++from_z) {
        const Lines& lines = stack[static_cast<std::size_t>(from_z)];
        for (int from_l = 0; from_l < static_cast<int>(lines.size()); ++from_l) {
            const double across = (l - from_l) * lattice.row_pitch, up = (z - from_z) * lattice.layer_pitch;
            for (const WeightedRun& run : lines[static_cast<std::size_t>(from_l)]) {
                const double left = run.weight - across * across;
                if (left < 0 || left - up * up < 0) continue;
                const double reach = std::sqrt(left - up * up);
                runs.push_back({round_run(run.begin - reach), round_run(run.end + reach)});
            }
        }
    }
    return united(std::move(runs));
}

/// A solid of slabs, specks and slanted struts; `radius` makes a ball's radius of a random number.
template <typename Radius>
Stack random_stack(std::mt19937& random, int layers, int lines, Radius radius) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double density = unit(random), lean_y = unit(random) - 0.5, lean_z = unit(random) - 0.5;
    Stack stack;
    for (int z = 0; z < layers; ++z) {
        stack.emplace_back();
        for (int l = 0; l < lines; ++l) {
            std::vector<Run> runs;
            for (int i = 0; i < 3; ++i) {  // struts
                const auto at =
                    static_cast<std::int32_t>(2000 * i + 400 * (lean_y * l + (i - 1) * lean_z * z));
                if ((l + 3 * i) % 17 < 9) runs.push_back({at, at + 700});
            }
            while (unit(random) < density * 0.7) {
                const auto at = static_cast<std::int32_t>(8000 * unit(random));
                const auto length = static_cast<std::int32_t>(1 + 3000 * std::pow(unit(random), 4));
                runs.push_back({at, at + length});
            }
            if (unit(random) < 0.1) runs.clear();
            stack.back().emplace_back();
            for (const Run run : united(runs)) {
                const double r = radius(unit(random));
                stack.back().back().push_back({run.begin, run.end, r * r});
            }
        }
    }
    return stack;
}

WeightedRows rows_of(const Lines& lines) {
    WeightedRows rows;
    for (const auto& line : lines) rows.append_line(line);
    return rows;
}

RunRows spans_of(const Lines& lines) {
    RunRows rows;
    for (const auto& line : lines) {
        for (const WeightedRun& run : line) rows.push(run.begin, run.end);
        rows.end_line();
    }
    return rows;
}

void check_equal(std::span<const Run> line, const std::vector<Run>& expected) {
    REQUIRE(std::vector<Run>(line.begin(), line.end()) == expected);
}

/// What the void of a stack, in all directions, leaves of it.
Stack voids_of(const Stack& stack, int margin_layers, int margin_lines, double radius) {
    const double weight = radius * radius;
    const std::size_t lines = stack.front().size() + 2 * static_cast<std::size_t>(margin_lines);
    const Lines nothing(lines, {{-far, far, weight}});
    Stack voids(static_cast<std::size_t>(margin_layers), nothing);
    for (const Lines& layer : stack) {
        Lines inverse = nothing;
        for (std::size_t l = 0; l < layer.size(); ++l) {
            auto& line = inverse[l + static_cast<std::size_t>(margin_lines)];
            line.clear();
            std::int32_t at = -far;
            for (const WeightedRun& run : layer[l]) {
                line.push_back({at, run.begin, weight});
                at = run.end;
            }
            line.push_back({at, far, weight});
        }
        voids.push_back(inverse);
    }
    voids.insert(voids.end(), static_cast<std::size_t>(margin_layers), nothing);
    return voids;
}

std::vector<Run> gaps(const std::vector<Run>& runs) {
    std::vector<Run> result;
    std::int32_t at = runs.front().end;
    for (std::size_t i = 1; i < runs.size(); ++i) {
        result.push_back({at, runs[i].begin});
        at = runs[i].end;
    }
    return result;
}

}  // namespace

TEST_CASE("grown rows equal brute force", "[morphology]") {
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        const double radius = std::uniform_real_distribution<double>(0, 3000)(random);
        const bool varying = round % 2 == 1;
        const LayerLattice lattice{round % 3 == 0 ? 256 : 190.5, 256, 40};
        const Stack stack =
            random_stack(random, 1, 40, [&](double unit) { return varying ? unit * radius : radius; });
        CAPTURE(round, radius);
        RunRows out;
        grow_rows(rows_of(stack[0]), lattice.row_pitch, out);
        REQUIRE(out.lines() == 40);
        for (int l = 0; l < 40; ++l)
            check_equal(out.line(static_cast<std::size_t>(l)), grown_line(stack, lattice, 0, l));
    }
}

TEST_CASE("rows less grown ones equal brute force", "[morphology]") {
    std::mt19937 random(7);
    std::int64_t left = 0;
    for (int round = 0; round < 60; ++round) {
        const double radius = std::uniform_real_distribution<double>(0, 1200)(random);
        const LayerLattice lattice{round % 3 == 0 ? 256 : 190.5, 256, 40};
        const Stack from = random_stack(random, 1, 40, [](double) { return 0.0; }),
                    taken = random_stack(random, 1, 40, [&](double) { return radius; });
        CAPTURE(round, radius);
        RunRows brute, expected, out;
        for (int l = 0; l < 40; ++l) brute.append_line(grown_line(taken, lattice, 0, l));
        subtract(spans_of(from[0]), brute, expected);
        subtract_dilated(spans_of(from[0]), spans_of(taken[0]), radius, lattice.row_pitch, out);
        REQUIRE(out == expected);
        left += out.total_length();
    }
    CHECK(left > 0);
}

TEST_CASE("shrunk rows equal brute force", "[morphology]") {
    std::mt19937 random(2);
    for (int round = 0; round < 30; ++round) {
        const double radius = std::uniform_real_distribution<double>(0, 900)(random);
        const LayerLattice lattice{256, 256, 40};
        const Stack stack = random_stack(random, 1, 40, [](double) { return 0.0; });
        const int margin = static_cast<int>(radius / 256);
        const Stack voids = voids_of(stack, 0, margin, radius);
        RunRows out;
        shrink_rows(spans_of(stack[0]), radius, lattice.row_pitch, out);
        REQUIRE(out.lines() == 40);
        for (int l = 0; l < 40; ++l)
            check_equal(out.line(static_cast<std::size_t>(l)),
                        gaps(grown_line(voids, lattice, 0, l + margin)));
    }
}

TEST_CASE("grown layers equal brute force", "[morphology]") {
    std::mt19937 random(3);
    for (int round = 0; round < 24; ++round) {
        const double radius = std::uniform_real_distribution<double>(0, round < 12 ? 1500 : 5000)(random);
        const bool varying = round % 2 == 1;
        // Rows apart as far as run ends or less, layers thinner; or a ball that is flat.
        const LayerLattice lattice{round % 3 == 0 ? 256 : 170.25, round % 4 < 2 ? 256.0 : 412.5, 18};
        const int layers = 50;
        const Stack stack =
            random_stack(random, layers, 18, [&](double unit) { return varying ? unit * radius : radius; });
        CAPTURE(round, radius);
        const auto out = through(DilationStream(lattice, radius), stack, rows_of);
        REQUIRE(out.size() == stack.size());
        for (int z = 0; z < layers; z += 3) {
            for (int l = 0; l < 18; ++l) {
                check_equal(out[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(l)),
                            grown_line(stack, lattice, z, l));
            }
        }
    }
}

TEST_CASE("balls on either side of the size from which blocks are faster grow the same", "[morphology]") {
    std::mt19937 random(8);
    constexpr int size = 40;
    for (int round = 0; round < 12; ++round) {
        // 150 to 620 lines in reach; ends that fall on a line or a layer, and that do not.
        const int in_lines = 9 + round / 2;
        const double radius = in_lines * run_unit * (round % 2 == 0 ? 1 : 0.77);
        const LayerLattice lattice{256, round % 3 == 0 ? 256 : 320.5, size};
        const Stack stack = random_stack(random, size, size, [&](double unit) {
            return round % 4 < 2 || unit < 0.5 ? radius : unit * radius;
        });
        CAPTURE(round, radius);
        const auto out = through(DilationStream(lattice, radius), stack, rows_of);
        REQUIRE(out.size() == stack.size());
        for (int z = 0; z < size; z += 5) {
            for (int l = 0; l < size; l += 3) {
                check_equal(out[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(l)),
                            grown_line(stack, lattice, z, l));
            }
        }
    }
}

TEST_CASE("shrunk layers equal brute force", "[morphology]") {
    std::mt19937 random(4);
    for (int round = 0; round < 10; ++round) {
        const double radius = std::uniform_real_distribution<double>(0, 1200)(random);
        const LayerLattice lattice{256, round % 2 == 0 ? 256.0 : 128.0, 24};
        const Stack stack = random_stack(random, 30, 24, [](double) { return 0.0; });
        const int margin_lines = static_cast<int>(radius / lattice.row_pitch);
        const int margin_layers = static_cast<int>(radius / lattice.layer_pitch);
        const Stack voids = voids_of(stack, margin_layers, margin_lines, radius);
        const auto out = through(ErosionStream(lattice, radius), stack, spans_of);
        REQUIRE(out.size() == stack.size());
        for (int z = 0; z < 30; z += 2) {
            for (int l = 0; l < 24; ++l) {
                check_equal(out[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(l)),
                            gaps(grown_line(voids, lattice, z + margin_layers, l + margin_lines)));
            }
        }
    }
}

TEST_CASE("large balls leave the right gaps between sparse solids", "[morphology]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 8; ++round) {
        // Blocks are halved up to five times; some balls are small beside others.
        const double radius = run_unit * (18 + 40 * unit(random));
        const LayerLattice lattice{256, round % 2 == 0 ? 256.0 : 201.5, 50};
        Stack stack(90, Lines(50));
        const int sites = round < 4 ? 12 : 150;
        for (int i = 0; i < sites; ++i) {
            const auto z = static_cast<std::size_t>(89.99 * unit(random));
            const auto l = static_cast<std::size_t>(49.99 * unit(random));
            if (!stack[z][l].empty()) continue;
            const auto at = static_cast<std::int32_t>(60000 * unit(random));
            const double r = round % 4 < 2 ? radius : radius * unit(random);
            stack[z][l].push_back({at, at + 1 + static_cast<std::int32_t>(900 * unit(random)), r * r});
        }
        CAPTURE(round, radius);
        const auto out = through(DilationStream(lattice, radius), stack, rows_of);
        REQUIRE(out.size() == stack.size());
        for (int z = 0; z < 90; z += 2) {
            for (int l = 0; l < 50; ++l) {
                check_equal(out[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(l)),
                            grown_line(stack, lattice, z, l));
            }
        }
    }
}

TEST_CASE("solids grow by balls of every size as by brute force", "[morphology]") {
    constexpr int size = 96;
    for (const double lines : {4.4, 6.2, 12.5, 33.3, 50.1}) {
        for (const bool slotted : {false, true}) {
            CAPTURE(lines, slotted);
            const LayerLattice lattice{256, slotted ? 201.5 : 256, size};
            const double radius = lines * run_unit, weight = radius * radius;
            Stack stack(size, Lines(size));
            for (int z = 0; z < size; ++z) {
                for (int l = 0; l < size; ++l) {
                    const double left = 30 * 30 - (z - 48) * (z - 48) - (l - 40.2) * (l - 40.2);
                    if (left <= 0) continue;
                    const std::int32_t half = round_run(std::sqrt(left) * run_unit);
                    std::vector<WeightedRun>& line =
                        stack[static_cast<std::size_t>(z)][static_cast<std::size_t>(l)];
                    const std::int32_t slot = slotted && half > 4000 ? 1500 + 20 * l : 0;
                    if (slot == 0) {
                        line = {{-half, half + 1, weight}};
                    } else {
                        line = {{-half, -slot, weight}, {slot, half, weight}};
                    }
                }
            }
            const auto out = through(DilationStream(lattice, radius), stack, rows_of);
            REQUIRE(out.size() == stack.size());
            for (int z = 0; z < size; z += 3) {
                for (int l = z % 4; l < size; l += 4) {
                    check_equal(out[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(l)),
                                grown_line(stack, lattice, z, l));
                }
            }
        }
    }
}

TEST_CASE("a run without an end stays so, whatever is grown beside it", "[morphology]") {
    const LayerLattice lattice{256, 256, 12};
    const double radius = 5 * run_unit, weight = radius * radius;
    Stack stack(20, Lines(12));
    stack[3][4] = {{-far, -700, weight}, {900, far, weight}};
    stack[12][9] = {{-far, far, weight}};
    stack[18][0] = {{100, 101, weight}};
    const auto out = through(DilationStream(lattice, radius), stack, rows_of);
    REQUIRE(out.size() == stack.size());
    for (int z = 0; z < 20; ++z) {
        for (int l = 0; l < 12; ++l) {
            std::vector<Run> expected = grown_line(stack, lattice, z, l);
            for (Run& run : expected) run = {std::max(run.begin, -far), std::min(run.end, far)};
            check_equal(out[static_cast<std::size_t>(z)].line(static_cast<std::size_t>(l)), expected);
        }
    }
}

TEST_CASE("a point grows into a ball, and a ball shrinks to a point", "[morphology]") {
    const double radius = 10 * run_unit;
    const LayerLattice lattice{run_unit, run_unit, 41};
    std::vector<RunRows> stack(41);
    for (std::size_t z = 0; z < 41; ++z) {
        for (std::size_t l = 0; l < 41; ++l) {
            if (z == 20 && l == 20) stack[z].push(0, 1);
            stack[z].end_line();
        }
    }
    const auto as_rows = [&](const RunRows& rows) { return WeightedRows(rows, radius); };
    double volume = 0;
    for (const RunRows& rows : through(DilationStream(lattice, radius), stack, as_rows))
        volume += static_cast<double>(rows.total_length());
    CHECK(volume / run_unit == Approx(4.0 / 3 * 3.14159265 * 1000).epsilon(0.01));
}

TEST_CASE("a layer that does not fit what was said of the stack is refused", "[morphology]") {
    const LayerLattice lattice{run_unit, run_unit, 2};
    DilationStream growing(lattice, 3 * run_unit);
    WeightedRows short_of_a_line, too_large;
    const WeightedRun fits{0, 700, 9.0 * run_unit * run_unit}, larger{0, 700, 9.1 * run_unit * run_unit};
    short_of_a_line.append_line(std::span(&fits, 1));
    too_large.append_line(std::span(&fits, 1));
    too_large.append_line(std::span(&larger, 1));
    CHECK_THROWS_AS(growing.push(short_of_a_line), FaultError);
    CHECK_THROWS_AS(growing.push(too_large), FaultError);
    short_of_a_line.append_line({});
    growing.push(short_of_a_line);
    growing.finish();
    RunRows out;
    REQUIRE(growing.pop(out));
    CHECK(out.line(1).size() == 1);
}

}  // namespace layer_offset_test
