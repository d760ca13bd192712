// Cells of rows: against runs cell by cell, and grown by discs cell by cell, on every SIMD target.
#include "engine/morphology/row_bitmask.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/simd_target.h"

namespace row_bitmask_test {

using namespace lamella;

namespace {

constexpr std::int32_t cell = CellLattice::cell;

RunRows random_rows(std::mt19937& random, int lines, int columns) {
    std::uniform_int_distribution<int> gap(1, 12 * run_unit), run(1, 9 * run_unit), any(0, 4);
    RunRows rows;
    for (int l = 0; l < lines; ++l) {
        if (any(random) != 0) {
            for (int u = gap(random) - 3 * run_unit; u < columns * run_unit;) {
                const int end = u + run(random);
                rows.push(u, end);
                u = end + gap(random);
            }
        }
        rows.end_line();
    }
    return rows;
}

CellLattice lattice_of(const RunRows& rows, int columns, double reach) {
    return {{-3 * run_unit, (columns + 9) * run_unit}, rows.lines(), reach, run_unit};
}

int columns_of(const CellLattice& lattice) { return static_cast<int>(lattice.words) * 64; }

bool has(const RowBitmask& cells, int line, int column) {
    const CellLattice& lattice = cells.lattice();
    if (line < 0 || line >= static_cast<int>(lattice.lines) || column < 0 || column >= columns_of(lattice))
        return false;
    const std::uint64_t* const words = cells.column(static_cast<std::size_t>(column) / 64);
    return (words[line] >> (column % 64) & 1) != 0;
}

/// Run units of a cell that lie in a line's runs.
int length_in(std::span<const Run> runs, std::int32_t begin) {
    int length = 0;
    for (const Run& run : runs)
        length += std::max(0, std::min(run.end, begin + cell) - std::max(run.begin, begin));
    return length;
}

bool any_within(const RowBitmask& cells, const DiscWidths& disc, int line, int column) {
    for (int k = 0; k < static_cast<int>(disc.size()); ++k) {
        const std::int32_t width = disc[static_cast<std::size_t>(k)];
        for (std::int32_t d = -width; d <= width; ++d) {
            if (has(cells, line - k, column + d) || has(cells, line + k, column + d)) return true;
        }
    }
    return false;
}

}  // namespace

TEST_CASE("cells are filled or met as their runs say", "[morphology]") {
    std::mt19937 random(1);
    const RunRows rows = random_rows(random, 23, 70);
    const CellLattice lattice = lattice_of(rows, 70, 3.5 * run_unit);
    REQUIRE(lattice.margin_lines >= 3);
    const LayerCells cells(rows, lattice);
    int filled = 0, partly = 0;
    for (int l = 0; l < static_cast<int>(lattice.lines); ++l) {
        const int row = l - static_cast<int>(lattice.margin_lines);
        const bool is_row = row >= 0 && row < static_cast<int>(rows.lines());
        for (int c = 0; c < columns_of(lattice); ++c) {
            const int length =
                is_row ? length_in(rows.line(static_cast<std::size_t>(row)), lattice.first + c * cell) : 0;
            REQUIRE(has(cells.outer, l, c) == (length > 0));
            REQUIRE(has(cells.inner, l, c) == (length == cell));
            filled += length == cell ? 1 : 0;
            partly += length > 0 && length < cell ? 1 : 0;
        }
    }
    CHECK(filled > 100);
    CHECK(partly > 100);
    // Whatever is met holds all of the rows, and what lies in the others none of it.
    CHECK(cells.outer.clip(rows, lattice.margin_lines) == rows);
    RowBitmask others = cells.outer;
    others.invert();
    CHECK(others.clip(rows, lattice.margin_lines).runs().empty());
    CHECK(cells.inner.clip(rows, lattice.margin_lines).total_length() == std::int64_t{filled} * cell);
    RowBitmask none = others;
    none.subtract_dilated(others, outer_disc(run_unit, run_unit));
    CHECK(none.runs(0, lattice.lines).runs().empty());
    CHECK(!others.runs(0, lattice.lines).runs().empty());
}

TEST_CASE("cells grow by all that a disc about them may meet, and no further", "[morphology]") {
    std::mt19937 random(2);
    const RunRows rows = random_rows(random, 31, 40);
    for (const double radius : {0.3, 1.0, 2.6, 9.4, 40.0}) {
        const CellLattice lattice = lattice_of(rows, 40, radius * run_unit);
        const RowBitmask cells = LayerCells(rows, lattice).inner,
                         all = LayerCells(random_rows(random, 31, 40), lattice).outer;
        const DiscWidths covered = inner_disc(radius * run_unit, run_unit),
                         met = outer_disc(radius * run_unit, run_unit);
        for (std::size_t k = 0; k < met.size(); ++k) {
            const double reach = std::sqrt(radius * radius - double(k) * double(k)) * run_unit;
            CHECK(covered[k] * cell <= reach + 1);
            CHECK(met[k] * cell >= reach - 1);
            CHECK(met[k] - covered[k] <= 1);
        }
        for (const DiscWidths& disc : {covered, met}) {
            for (const std::string& target : simd_targets()) {
                force_simd_target(target);
                const RowBitmask grown = cells.grown(disc), beyond = cells.beyond(disc);
                RowBitmask left = all;
                left.subtract_dilated(cells, disc);
                force_simd_target("");
                INFO("radius " << radius << " on " << target);
                for (int l = 0; l < static_cast<int>(lattice.lines); ++l) {
                    for (int c = 0; c < columns_of(lattice); c += 1 + l % 3) {
                        const bool within = any_within(cells, disc, l, c);
                        REQUIRE(has(grown, l, c) == within);
                        REQUIRE(has(beyond, l, c) == !within);
                        REQUIRE(has(left, l, c) == (has(all, l, c) && !within));
                    }
                }
            }
        }
    }
}

TEST_CASE("cells grow the same where lines end", "[morphology]") {
    const CellLattice lattice({0, 100 * run_unit}, 5, 0, run_unit);
    for (const double radius : {1.0, 1.6, 2.6, 5.2, 20.0, 45.0}) {
        const DiscWidths disc = outer_disc(radius * run_unit, run_unit);
        for (const int column : {0, 1, 63, 64, columns_of(lattice) - 2, columns_of(lattice) - 1}) {
            RowBitmask cells(lattice);
            cells.column(static_cast<std::size_t>(column) / 64)[2] = std::uint64_t{1} << (column % 64);
            const RowBitmask grown = cells.grown(disc);
            INFO("radius " << radius << ", column " << column);
            for (int l = 0; l < static_cast<int>(lattice.lines); ++l) {
                for (int c = 0; c < columns_of(lattice); ++c)
                    REQUIRE(has(grown, l, c) == any_within(cells, disc, l, c));
            }
        }
    }
}

TEST_CASE("cells grow alike where few are, where all are, and in lines of many words", "[morphology]") {
    constexpr int columns = 10000;  // 158 words
    std::mt19937 random(3);
    std::uniform_int_distribution<std::size_t> any(0, 4);
    RunRows few, most;
    const std::vector<int> places{7, 640, 644, 6100, 9990};
    for (int l = 0; l < 41; ++l) {
        const int place = places[any(random)];
        if (l % 9 == 0) few.push(place * run_unit, (place + 3) * run_unit);
        few.end_line();
        most.push(0, (columns - place) * run_unit);
        most.push((columns - place + 2) * run_unit, columns * run_unit);
        most.end_line();
    }
    const CellLattice lattice({0, columns * run_unit}, few.lines(), 40 * run_unit, run_unit);
    REQUIRE(lattice.words > 2 * 64);
    for (const RunRows* rows : {&few, &most}) {
        const RowBitmask cells = LayerCells(*rows, lattice).outer;
        CHECK(cells.clip(*rows, lattice.margin_lines) == *rows);
        for (const double radius : {0.0, 1.5, 3.0, 39.0}) {
            const DiscWidths disc = outer_disc(radius * run_unit, run_unit);
            const RowBitmask grown = cells.grown(disc), beyond = cells.beyond(disc);
            RowBitmask left = LayerCells(most, lattice).outer;
            const RowBitmask all = left;
            left.subtract_dilated(cells, disc);
            INFO("radius " << radius << (rows == &few ? ", few" : ", most"));
            for (int l = 0; l < static_cast<int>(lattice.lines); ++l) {
                for (int c = l % 5; c<columns_of(lattice); c += radius> 10 ? 97 : 5) {
                    const bool within = any_within(cells, disc, l, c);
                    REQUIRE(has(grown, l, c) == within);
                    REQUIRE(has(beyond, l, c) == !within);
                    REQUIRE(has(left, l, c) == (has(all, l, c) && !within));
                }
            }
        }
    }
}

}  // namespace row_bitmask_test
