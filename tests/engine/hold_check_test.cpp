// What holds a layer, in rows written down one by one.
#include "engine/hold_check.h"

#include <catch2/catch.hpp>
#include <map>

#include "engine/row_sets.h"

using namespace lamella;

namespace {

constexpr int lines = 12;
constexpr std::int32_t width = 20 * run_unit;  // of the block
using Rows = std::multimap<int, Run>;

SpanRows rows_of(const Rows& runs) {
    SpanRows rows;
    for (int r = 0; r < lines; ++r) {
        for (auto [at, end] = runs.equal_range(r); at != end; ++at)
            rows.push(at->second.begin, at->second.end);
        rows.end_line();
    }
    return rows;
}

/// A block of four rows in each of two layers, and what else is in the second.
std::size_t islands_beside_a_block(const Rows& beside) {
    CheckGrid grid;
    grid.band.count = lines;
    grid.band.hi = 40;
    grid.layer_height = 1;
    PrintLimits limits;
    limits.verdicts.fill(Verdict::off);
    limits.verdicts[static_cast<std::size_t>(Check::islands)] = Verdict::fail;
    Rows block;
    for (int r = 5; r < 9; ++r) block.emplace(r, Run{0, width});
    Rows second = block;
    second.insert(beside.begin(), beside.end());
    HoldCheck hold(grid, limits, 10);
    int index = 0;
    for (const Rows& runs : {block, second}) {
        const SpanRows rows = rows_of(runs);
        hold.add({rows, empty_rows(rows.lines()), {}},
                 LayerCells(rows, {Run{0, grid.band.hi * run_unit}, rows.lines(), 0, run_unit}),
                 label_layer(rows, index, Growth{}), index);
        ++index;
    }
    hold.finish();
    return hold.islands().count();
}

}  // namespace

TEST_CASE("what is smaller than a sample is no island within a pitch of what is held", "[check]") {
    const Run near{width + 100, width + 300};
    CHECK(islands_beside_a_block({}) == 0);
    CHECK(islands_beside_a_block({{9, near}}) == 0);
    CHECK(islands_beside_a_block({{4, near}}) == 0);
    CHECK(islands_beside_a_block({{8, near}}) == 0);
    // Further along, further across, or larger.
    CHECK(islands_beside_a_block({{9, {width + 257, width + 400}}}) == 1);
    CHECK(islands_beside_a_block({{10, near}}) == 1);
    CHECK(islands_beside_a_block({{9, {width + 100, width + 100 + run_unit}}}) == 1);
    CHECK(islands_beside_a_block({{9, {width + 100, width + 240}}, {10, {width + 100, width + 240}}}) == 1);
    // Of several in a row each holds the next, whichever way they lie.
    const Run next{width + 500, width + 700}, last{width + 900, width + 1100};
    CHECK(islands_beside_a_block({{9, near}, {10, next}, {11, last}}) == 0);
    CHECK(islands_beside_a_block({{4, near}, {3, next}, {2, last}}) == 0);
    CHECK(islands_beside_a_block({{10, next}, {11, last}}) == 2);
}
