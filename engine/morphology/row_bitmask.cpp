// RowBitmask: conversion of runs to bits and back. The dilation is in row_bitmask_simd.cpp.
#include "engine/morphology/row_bitmask.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "engine/morphology/weighted_rows.h"
#include "engine/runs/bit_runs.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr std::int32_t word_cells = CellLattice::word_cells;
constexpr std::int32_t word_units = word_cells * CellLattice::cell;

/// Converts run units to cells, rounded towards minus infinity.
std::int32_t cells_down(std::int32_t units) { return units >> std::countr_zero(unsigned{CellLattice::cell}); }
std::int32_t cells_up(std::int32_t units) { return cells_down(units + CellLattice::cell - 1); }

template <typename Width>
DiscWidths disc_widths(double radius, double row_pitch, Width width) {
    DiscWidths widths;
    for (int k = 0;; ++k) {
        const double across = k * row_pitch, left = radius * radius - across * across;
        if (left < 0) return widths;
        widths.push_back(width(RoundedExtent(std::sqrt(left))));
    }
}

/// Returns true if any of lines_at_once words has a bit.
bool any_bit(const std::uint64_t* words) {
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < CellLattice::lines_at_once; ++i) all |= words[i];
    return all != 0;
}

/// Returns the number of words from column to column: an odd number of cache lines, so that columns do not
/// compete for the same cache sets.
std::size_t stride_of(const CellLattice& lattice) {
    constexpr std::size_t cache_line = 8;  // words
    return ((lattice.lines + CellLattice::lines_at_once) / cache_line | 1) * cache_line;
}

}  // namespace

CellLattice::CellLattice(Run extent, std::size_t row_count, double reach, double row_pitch)
    : margin_lines(static_cast<std::size_t>(reach / row_pitch) + 1) {
    const std::int32_t beside = static_cast<std::int32_t>(reach) + cell;
    first = cells_down(extent.begin - beside) * cell;
    words = static_cast<std::size_t>((extent.end + beside - first) / word_units) + 1;
    lines = (row_count + 2 * margin_lines + lines_at_once - 1) / lines_at_once * lines_at_once;
}

DiscWidths inner_disc(double radius, double row_pitch) {
    return disc_widths(radius, row_pitch, [](const RoundedExtent& reach) { return cells_down(reach.back); });
}

DiscWidths outer_disc(double radius, double row_pitch) {
    return disc_widths(radius, row_pitch, [](const RoundedExtent& reach) { return cells_up(reach.ahead); });
}

RowBitmask::RowBitmask(const CellLattice& lattice)
    : lattice_(lattice), stride_(stride_of(lattice)), words_(place(lattice.words)) {}

LayerCells::LayerCells(const RunRows& rows, const CellLattice& lattice) : inner(lattice), outer(lattice) {
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        const std::size_t line = l + lattice.margin_lines;
        for (const Run& run : rows.line(l)) {
            const std::int32_t begin = run.begin - lattice.first, end = run.end - lattice.first;
            inner.mark(cells_up(begin), cells_down(end), line);
            outer.mark(cells_down(begin), cells_up(end), line);
        }
    }
}

void RowBitmask::mark(std::int32_t first, std::int32_t end, std::size_t line) {
    if (first >= end) return;
    const auto low = static_cast<std::size_t>(first / word_cells),
               high = static_cast<std::size_t>((end - 1) / word_cells);
    const std::uint64_t from = ~std::uint64_t{0} << (first % word_cells),
                        to = ~std::uint64_t{0} >> (word_cells - 1 - (end - 1) % word_cells);
    if (low == high) {
        column(low)[line] |= from & to;
        return;
    }
    column(low)[line] |= from;
    for (std::size_t i = low + 1; i < high; ++i) column(i)[line] = ~std::uint64_t{0};
    column(high)[line] |= to;
}

void RowBitmask::invert() {
    for (std::size_t i = 0; i < lattice_.words; ++i) {
        std::uint64_t* const words = column(i);
        for (std::size_t l = 0; l < lattice_.lines; ++l) words[l] = ~words[l];
    }
}

RunRows RowBitmask::runs(std::size_t first_line, std::size_t count) const {
    constexpr std::size_t at_once = CellLattice::lines_at_once;
    struct CellRun {
        std::size_t line;
        Run run;
    };
    std::vector<CellRun> found;  // column by column
    std::vector<std::uint32_t> starts(lattice_.lines + 1, 0);
    for (std::size_t i = 0; i < lattice_.words; ++i) {
        const std::uint64_t* const words = column(i);
        const std::int32_t first = lattice_.first + static_cast<std::int32_t>(i) * word_units;
        for (std::size_t block = 0; block < lattice_.lines; block += at_once) {
            if (!any_bit(words + block)) continue;
            for (std::size_t l = block; l < block + at_once; ++l) {
                for_bit_runs(words[l], [&](int begin, int end) {
                    found.push_back(
                        {l, {first + begin * CellLattice::cell, first + end * CellLattice::cell}});
                    ++starts[l + 1];
                });
            }
        }
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<Run> sorted(found.size());
    for (const CellRun& cells : found)
        sorted[starts[cells.line]++] = cells.run;  // starts[l] becomes the end of line l
    RunRows all;
    all.reserve(count, sorted.size());
    std::uint32_t i = first_line > 0 ? starts[first_line - 1] : 0;
    for (std::size_t l = first_line; l < first_line + count; ++l) {
        for (; i < starts[l]; ++i) all.push(sorted[i].begin, sorted[i].end);
        all.end_line();
    }
    return all;
}

RunRows RowBitmask::clip(const RunRows& rows, std::size_t first_line) const {
    RunRows inside;
    intersect(runs(first_line, rows.lines()), rows, inside);
    return inside;
}

}  // namespace lamella
