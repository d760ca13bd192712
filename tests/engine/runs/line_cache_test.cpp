// Lines kept on the way are those of their numbers, and nobody else's lines are taken for them.
#include "engine/runs/line_cache.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

namespace line_cache_test {

using namespace lamella;

namespace {

/// Rows 3 to 40 with three lines each; line n has n % 4 runs.
RowBand whole_band() {
    return {.axis = Axis::y, .across_pitch = -0.1, .first = 3, .count = 37, .sub = 3, .hi = 100};
}
RunRows rows_of(const RowBand& band) {
    RunRows rows;
    for (int l = 0; l < band.lines(); ++l) {
        for (int k = 0; k < band.number(l) % 4; ++k) rows.push(1000 * k, 1000 * k + band.number(l));
        rows.end_line();
    }
    return rows;
}

RowBand wanted_band() {
    RowBand wanted = whole_band();
    wanted.first = 5;
    wanted.count = 33;
    wanted.step = 7;
    return wanted;
}

/// Goes through the rows of `band`, some at a time; leaves out those from `gap_begin` to `gap_end`.
void go_through(RowBand band, int gap_begin, int gap_end, LineCache& kept) {
    const RowBand all = band;
    for (; band.first < all.first + all.count; band.first += 4) {
        band.count = std::min(4, all.first + all.count - band.first);
        if (band.first >= gap_begin && band.first < gap_end) continue;
        kept.add(band, rows_of(band));
    }
}

}  // namespace

TEST_CASE("lines are kept by their numbers, and what is passed over is empty", "[kept_lines]") {
    const RowBand wanted = wanted_band();
    LineCache kept(wanted);
    go_through(whole_band(), 11, 19, kept);
    CHECK(kept.rows() == nullptr);
    kept.finish(whole_band());
    REQUIRE(kept.rows() != nullptr);
    const RunRows expected = rows_of(wanted);
    REQUIRE(kept.rows()->lines() == expected.lines());
    std::size_t empty = 0;
    for (int l = 0; l < wanted.lines(); ++l) {
        const auto line = kept.rows()->line(static_cast<std::size_t>(l));
        const int row = wanted.number(l) / wanted.sub;
        if (row >= 11 && row < 19) {
            CHECK(line.empty());
            ++empty;
        } else {
            CHECK(std::ranges::equal(line, expected.line(static_cast<std::size_t>(l))));
        }
    }
    CHECK(empty == 4);  // 35, 42, 49 and 56
    // Another one that goes through them changes nothing.
    go_through(whole_band(), 0, 0, kept);
    CHECK(kept.rows()->lines() == expected.lines());
}

TEST_CASE("lines that lie elsewhere or are told otherwise are not kept", "[kept_lines]") {
    std::vector<RowBand> others(6, whole_band());
    others[0].axis = Axis::x;
    others[1].along_origin = 0.01;
    others[2].across_pitch = 0.1;
    others[3].sub = 4;
    others[4].hi = 99;
    others[5].step = 7;
    for (const RowBand& other : others) {
        LineCache kept(wanted_band());
        go_through(other, 0, 0, kept);
        kept.finish(other);
        CHECK(kept.rows() == nullptr);
    }
}

}  // namespace line_cache_test
