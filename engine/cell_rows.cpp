// Runs become words, and words runs.
#include "engine/cell_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/ball_rows.h"

namespace lamella {
namespace {

constexpr std::int32_t word_cells = 64;
constexpr std::int32_t word_units = word_cells * CellLattice::cell;

/// Rounded down, whatever the sign.
std::int32_t cells_down(std::int32_t units) { return units >> std::countr_zero(unsigned{CellLattice::cell}); }
std::int32_t cells_up(std::int32_t units) { return cells_down(units + CellLattice::cell - 1); }

template <typename Width>
DiscWidths disc_widths(double radius, double row_pitch, Width width) {
    DiscWidths widths;
    for (int k = 0;; ++k) {
        const double across = k * row_pitch, left = radius * radius - across * across;
        if (left < 0) return widths;
        widths.push_back(width(BallReach(std::sqrt(left))));
    }
}

/// Adds the cells [first, end) of a line to a set.
void mark(std::int32_t first, std::int32_t end, std::size_t line, CellRows& cells) {
    if (first >= end) return;
    const auto low = static_cast<std::size_t>(first / word_cells),
               high = static_cast<std::size_t>((end - 1) / word_cells);
    const std::uint64_t from = ~std::uint64_t{0} << (first % word_cells),
                        to = ~std::uint64_t{0} >> (word_cells - 1 - (end - 1) % word_cells);
    if (low == high) {
        cells.column(low)[line] |= from & to;
        return;
    }
    cells.column(low)[line] |= from;
    for (std::size_t i = low + 1; i < high; ++i) cells.column(i)[line] = ~std::uint64_t{0};
    cells.column(high)[line] |= to;
}

/// From column to column of words: an odd number of cache lines, lest columns share places in the cache.
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

DiscWidths cells_covered(double radius, double row_pitch) {
    return disc_widths(radius, row_pitch, [](const BallReach& reach) { return cells_down(reach.back); });
}

DiscWidths cells_met(double radius, double row_pitch) {
    return disc_widths(radius, row_pitch, [](const BallReach& reach) { return cells_up(reach.ahead); });
}

CellRows::CellRows(const CellLattice& lattice)
    : lattice_(lattice), stride_(stride_of(lattice)), words_(place(lattice.words)) {}

LayerCells::LayerCells(const SpanRows& rows, const CellLattice& lattice) : filled(lattice), met(lattice) {
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        const std::size_t line = l + lattice.margin_lines;
        for (const Run& run : rows.line(l)) {
            const std::int32_t begin = run.begin - lattice.first, end = run.end - lattice.first;
            mark(cells_up(begin), cells_down(end), line, filled);
            mark(cells_down(begin), cells_up(end), line, met);
        }
    }
}

bool CellRows::any() const {
    std::uint64_t all = 0;
    for (const std::uint64_t word : words_) all |= word;
    return all != 0;
}

std::vector<std::uint64_t> CellRows::united_words() const {
    std::vector<std::uint64_t> all(lattice_.lines);
    for (std::size_t i = 0; i < lattice_.words; ++i) {
        const std::uint64_t* const words = column(i);
        for (std::size_t l = 0; l < all.size(); ++l) all[l] |= words[l];
    }
    return all;
}

void CellRows::invert() {
    for (std::size_t i = 0; i < lattice_.words; ++i) {
        std::uint64_t* const words = column(i);
        for (std::size_t l = 0; l < lattice_.lines; ++l) words[l] = ~words[l];
    }
}

/// Calls take(begin, end) for runs of cells, one after another; some may touch.
template <typename Take>
void CellRows::for_runs(std::size_t line, Take take) const {
    for (std::size_t i = 0; i < lattice_.words; ++i) {
        std::int32_t at = lattice_.first + static_cast<std::int32_t>(i) * word_units;
        for (std::uint64_t word = column(i)[line]; word != 0;) {
            const int void_cells = std::countr_zero(word);
            at += void_cells * CellLattice::cell;
            word >>= void_cells;
            const int cells = std::countr_one(word);
            take(at, at + cells * CellLattice::cell);
            at += cells * CellLattice::cell;
            word = cells == word_cells ? 0 : word >> cells;
        }
    }
}

SpanRows CellRows::of(const SpanRows& rows, std::size_t first_line) const {
    const std::vector<std::uint64_t> in_line = united_words();
    SpanRows inside;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        const std::span<const Run> runs = rows.line(l);
        if (!runs.empty() && in_line[first_line + l] != 0) {
            auto next = runs.begin();
            for_runs(first_line + l, [&](std::int32_t begin, std::int32_t end) {
                while (next != runs.end() && next->end <= begin) ++next;
                for (auto run = next; run != runs.end() && run->begin < end; ++run)
                    inside.push(std::max(run->begin, begin), std::min(run->end, end));
            });
        }
        inside.end_line();
    }
    return inside;
}

}  // namespace lamella
