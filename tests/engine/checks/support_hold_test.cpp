// What supports hold: against the distance of each point to each support.
#include "engine/checks/support_hold.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/runs/row_sets.h"

namespace support_hold_test {

using namespace lamella;

namespace {

constexpr int row_count = 40, columns = 60;
constexpr double pitch = 0.1, height = 0.05;

CheckGrid grid() {
    CheckGrid grid;
    grid.band.along_pitch = grid.band.across_pitch = pitch;
    grid.band.count = row_count;
    grid.band.hi = columns;
    grid.layers = {1 << 20, height};
    return grid;
}

RunRows random_rows(std::mt19937& random, int one_of_rows, int gap_columns) {
    std::uniform_int_distribution<int> gap(1, gap_columns * run_unit), run(1, 4 * run_unit),
        any(1, one_of_rows);
    RunRows rows;
    for (int l = 0; l < row_count; ++l) {
        for (int u = gap(random); any(random) == 1 && u < columns * run_unit;) {
            const int end = u + run(random);
            rows.push(u, end);
            u = end + gap(random);
        }
        rows.end_line();
    }
    return rows;
}

/// By how many run units a point of the next layer lies further from all supports than they hold; less than
/// nothing where it is held.
double beyond_hold(const std::vector<RunRows>& layers, double spacing, double gap, int row, double u) {
    const double unit = pitch / run_unit;
    double least = 1e9;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const double way = std::max(static_cast<double>(layers.size() - 1 - i) * height - gap, 0.0);
        if (way > spacing) continue;
        const double reach = std::sqrt(spacing * spacing - way * way) / unit;
        for (int r = 0; r < row_count; ++r) {
            for (const Run& run : layers[i].line(static_cast<std::size_t>(r))) {
                const double along = std::max({run.begin - u, u - run.end, 0.0});
                least = std::min(least, std::hypot(along, (r - row) * double(run_unit)) - reach);
            }
        }
    }
    return least;
}

bool has(const RunRows& rows, int row, double u) {
    const auto runs = rows.line(static_cast<std::size_t>(row));
    return std::ranges::any_of(runs, [&](const Run& run) { return run.begin < u && u < run.end; });
}

}  // namespace

TEST_CASE("supports hold all that lies near enough, at their height or above", "[check]") {
    std::mt19937 random(5);
    for (const double gap : {0.0, 0.12}) {
        const double spacing = 0.7;
        SupportHold hold(grid(), spacing, gap);
        std::vector<RunRows> layers;
        const RunRows any = random_rows(random, 1, 3);
        CHECK(hold.unheld(any) == any);
        int held = 0, unheld = 0;
        for (int i = 0; i < 30; ++i) {
            // Some supports go on, some end; for a while there are none.
            layers.push_back(i == 0 || i % 7 == 3 ? random_rows(random, 9, 40) : layers.back());
            if (i > 12) layers.back() = empty_rows(row_count);
            hold.add(layers.back());
            const RunRows rows = random_rows(random, 2, 5), left = hold.unheld(rows);
            REQUIRE(left.lines() == rows.lines());
            for (int r = 0; r < row_count; ++r) {
                for (double u = 0.5; u < (columns + 5) * run_unit; u += 37) {
                    const double beyond = beyond_hold(layers, spacing, gap, r, u);
                    if (std::abs(beyond) < 2) continue;  // ends are rounded
                    INFO("layer " << i << ", row " << r << ", unit " << u << ", " << beyond);
                    REQUIRE(has(left, r, u) == (has(rows, r, u) && beyond > 0));
                    if (has(rows, r, u)) ++(beyond > 0 ? unheld : held);
                }
            }
        }
        CHECK(held > 3000);
        CHECK(unheld > 3000);
        CHECK(hold.unheld(empty_rows(row_count)) == empty_rows(row_count));
    }
}

}  // namespace support_hold_test
