// Builds the lattice: rows decide, columns are adapted.
#include "engine/contours/lattice.h"

#include <cmath>

#include "engine/field/slice_context.h"

namespace lamella {
namespace {

constexpr int lines_per_band = 64;
/// A column crossing closer than this to a wrong node (a quarter pitch) is moved over it; a farther one is
/// kept and a pair is inserted.
constexpr std::int32_t near_node = run_unit / 4;

/// Converts runs to crossings that avoid nodes and the grid's outside. Coinciding crossings cancel in pairs.
void push_crossings(std::span<const Run> runs, std::int32_t end, std::vector<std::int32_t>& out) {
    const std::size_t first = out.size();
    const auto push = [&](std::int32_t u) {
        u = std::min(std::max(u, 1), end - 1);
        if ((u & (run_unit - 1)) == 0) --u;
        if (out.size() > first && out.back() == u) {
            out.pop_back();
        } else {
            out.push_back(u);
        }
    };
    for (const Run& run : runs) {
        push(run.begin);
        push(run.end);
    }
}

/// Inserts a crossing into a sorted list, or removes it if it is there.
void toggle(std::vector<std::int32_t>& list, std::int32_t u) {
    const auto place = std::lower_bound(list.begin(), list.end(), u);
    if (place != list.end() && *place == u) {
        list.erase(place);
    } else {
        list.insert(place, u);
    }
}

/// Inverts nodes first .. last of a column. A crossing near an end of the stretch moves over the node there;
/// otherwise a new crossing is inserted beside the node.
void turn_over(std::vector<std::int32_t>& column, int first, int last) {
    const std::int32_t low = first * run_unit, high = last * run_unit;
    const auto below = std::lower_bound(column.begin(), column.end(), low);
    const auto above = std::lower_bound(column.begin(), column.end(), high);
    const bool near_below = below != column.begin() && low - *(below - 1) <= near_node;
    const bool near_above = above != column.end() && *above - high <= near_node;
    const std::int32_t from = near_below ? *(below - 1) : low - 1, to = near_above ? *above : high + 1;
    toggle(column, from);
    toggle(column, to);
}

}  // namespace

Lattice::Lattice(const SliceField& slice, const Grid& grid, Scratch& scratch) : grid_(grid) {
    add_rows(slice, scratch);
    add_columns(slice, scratch);
}

void Lattice::add_rows(const SliceField& slice, Scratch& scratch) {
    RowBand band{Axis::x, grid_.origin.x, grid_.pitch.x, grid_.origin.y - 0.5 * grid_.pitch.y, grid_.pitch.y};
    band.hi = grid_.columns;
    const auto rows = scratch.rows();
    std::vector<std::int32_t> line;
    row_starts_.assign(1, 0);
    for (int first = 0; first <= grid_.rows; first += lines_per_band) {
        band.first = first;
        band.count = std::min(lines_per_band, grid_.rows + 1 - first);
        rows->clear();
        slice.runs(band, scratch, *rows);
        for (int l = 0; l < band.count; ++l) {
            const int j = first + l;
            line.clear();
            const bool border = j == 0 || j == grid_.rows;
            if (!border)
                push_crossings(rows->line(static_cast<std::size_t>(l)), grid_.columns * run_unit, line);
            for (const std::int32_t x : line) crossings_.push_back({x, j * run_unit});
            row_starts_.push_back(static_cast<std::uint32_t>(crossings_.size()));
        }
    }
}

void Lattice::add_columns(const SliceField& slice, Scratch& scratch) {
    RowBand band{Axis::y, grid_.origin.y, grid_.pitch.y, grid_.origin.x - 0.5 * grid_.pitch.x, grid_.pitch.x};
    band.hi = grid_.rows;
    const auto lines = scratch.rows();
    std::vector<std::vector<std::int32_t>> columns(static_cast<std::size_t>(grid_.columns) + 1);
    for (int first = 0; first <= grid_.columns; first += lines_per_band) {
        band.first = first;
        band.count = std::min(lines_per_band, grid_.columns + 1 - first);
        lines->clear();
        slice.runs(band, scratch, *lines);
        for (int l = 0; l < band.count; ++l) {
            const int i = first + l;
            if (i == 0 || i == grid_.columns) continue;
            push_crossings(lines->line(static_cast<std::size_t>(l)), grid_.rows * run_unit,
                           columns[static_cast<std::size_t>(i)]);
        }
    }
    bucket_columns(columns);
    if (mend_columns(columns)) bucket_columns(columns);
}

void Lattice::bucket_columns(const std::vector<std::vector<std::int32_t>>& columns) {
    const auto rows = static_cast<std::size_t>(grid_.rows);
    crossings_.resize(row_crossings());
    column_starts_.assign(rows + 1, 0);
    for (const auto& column : columns) {
        for (const std::int32_t y : column) ++column_starts_[static_cast<std::size_t>(y >> 8) + 1];
    }
    column_starts_[0] = row_crossings();
    for (std::size_t j = 1; j <= rows; ++j) column_starts_[j] += column_starts_[j - 1];
    crossings_.resize(column_starts_[rows]);
    std::vector<std::uint32_t> next(column_starts_.begin(), column_starts_.end() - 1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        for (const std::int32_t y : columns[i]) {
            crossings_[next[static_cast<std::size_t>(y >> 8)]++] = {static_cast<std::int32_t>(i) * run_unit,
                                                                    y};
        }
    }
}

bool Lattice::mend_columns(std::vector<std::vector<std::int32_t>>& columns) const {
    // In each cell row, a column edge must have an odd number of crossings if and only if its two nodes
    // differ. The columns where two neighbouring rows differ are computed as runs, too: the symmetric
    // difference of two sorted lists. A wrong edge has exactly one wrong node, so all nodes between two wrong
    // edges of a column are wrong.
    std::vector<std::pair<int, int>> wrong_edges;
    std::vector<std::int32_t> flips;
    for (int j = 0; j < grid_.rows; ++j) {
        const auto row = [&](int k) {
            return crossings().subspan(
                row_starts_[static_cast<std::size_t>(k)],
                row_starts_[static_cast<std::size_t>(k) + 1] - row_starts_[static_cast<std::size_t>(k)]);
        };
        // First node behind each crossing, where the row changes between solid and void.
        flips.clear();
        for (const Crossing& c : row(j)) flips.push_back((c.x >> 8) + 1);
        const auto middle = static_cast<std::ptrdiff_t>(flips.size());
        for (const Crossing& c : row(j + 1)) flips.push_back((c.x >> 8) + 1);
        std::inplace_merge(flips.begin(), flips.begin() + middle, flips.end());

        std::uint32_t k = column_starts_[static_cast<std::size_t>(j)];
        const std::uint32_t end = column_starts_[static_cast<std::size_t>(j) + 1];
        const auto check = [&](int i, bool differ) {
            bool odd = false;
            for (; k < end && crossings_[k].x == i * run_unit; ++k) odd = !odd;
            if (odd != differ) wrong_edges.emplace_back(i, j);
        };
        for (std::size_t f = 0; f + 1 <= flips.size(); ++f) {
            const bool differ = f % 2 == 0;
            const int from = flips[f], to = f + 1 < flips.size() ? flips[f + 1] : from;
            // Between differing stretches, only columns with crossings need a check.
            while (k < end && crossings_[k].x < from * run_unit) check(crossings_[k].x >> 8, false);
            if (!differ) continue;
            for (int i = from; i < to; ++i) check(i, true);
        }
        while (k < end) check(crossings_[k].x >> 8, false);
    }
    std::sort(wrong_edges.begin(), wrong_edges.end());
    for (std::size_t k = 0; k + 1 < wrong_edges.size(); k += 2) {
        const auto [i, first] = wrong_edges[k];
        turn_over(columns[static_cast<std::size_t>(i)], first + 1, wrong_edges[k + 1].second);
    }
    return !wrong_edges.empty();
}

std::int64_t Lattice::before_node(int i, int j) const {
    const auto first = crossings_.begin() + row_starts_[static_cast<std::size_t>(j)];
    const auto last = crossings_.begin() + row_starts_[static_cast<std::size_t>(j) + 1];
    const auto place = std::lower_bound(first, last, i * run_unit,
                                        [](const Crossing& c, std::int32_t x) { return c.x < x; });
    return place == first ? -1 : place - crossings_.begin() - 1;
}

bool Lattice::solid(int i, int j) const {
    const std::int64_t before = before_node(i, j);
    return before >= 0 && (before - row_starts_[static_cast<std::size_t>(j)]) % 2 == 0;
}

Lattice::Walker::Walker(const Lattice& lattice, int j)
    : lattice_(lattice),
      bottom_(lattice.row_starts_[static_cast<std::size_t>(j)]),
      bottom_end_(lattice.row_starts_[static_cast<std::size_t>(j) + 1]),
      top_(bottom_end_),
      top_end_(lattice.row_starts_[static_cast<std::size_t>(j) + 2]),
      column_(lattice.column_starts_[static_cast<std::size_t>(j)]),
      column_end_(lattice.column_starts_[static_cast<std::size_t>(j) + 1]),
      row_start_(bottom_) {
    cell_.j = j;
    cell_.i = -1;
}

void Lattice::Walker::add_side(std::uint32_t from, std::uint32_t to, std::uint8_t side) {
    const bool backwards = side >= 2;
    for (std::uint32_t k = from; k < to; ++k) {
        border_.push_back(backwards ? to - 1 - (k - from) : k);
        side_.push_back(side);
    }
}

bool Lattice::Walker::next() {
    const auto& c = lattice_.crossings_;
    // Find the next cell with a crossing: on its bottom, top or left, or else on its right side.
    std::int32_t i = lattice_.grid_.columns;
    if (bottom_ < bottom_end_) i = std::min(i, c[bottom_].x >> 8);
    if (top_ < top_end_) i = std::min(i, c[top_].x >> 8);
    if (column_ < column_end_) {
        const std::int32_t column = c[column_].x >> 8;
        i = std::min(i, column > cell_.i + 1 ? column - 1 : column);
    }
    if (i >= lattice_.grid_.columns) return false;
    const auto run_to = [&](std::uint32_t k, std::uint32_t end, std::int32_t x_end) {
        while (k < end && c[k].x < x_end) ++k;
        return k;
    };
    const std::int32_t x0 = i * run_unit, x1 = x0 + run_unit;
    const std::uint32_t bottom = run_to(bottom_, bottom_end_, x1), top = run_to(top_, top_end_, x1);
    const std::uint32_t left = run_to(column_, column_end_, x0 + 1),
                        right = run_to(left, column_end_, x1 + 1);
    cell_.i = i;
    cell_.solid = (bottom_ - row_start_) % 2 == 1;
    border_.clear();
    side_.clear();
    add_side(bottom_, bottom, 0);
    add_side(left, right, 1);
    add_side(top_, top, 2);
    add_side(column_, left, 3);
    bottom_ = bottom;
    top_ = top;
    column_ = left;
    cell_.border = border_;
    cell_.side = side_;
    cell_.connect = border_.size() > 2 && joins();
    return true;
}

bool Lattice::Walker::joins() const {
    const std::size_t n = border_.size();
    // An arc between two crossings on one side is a thin strut (solid) or a thin gap (void) that passes
    // there.
    bool thin_solid = false, thin_void = false, one_side = true;
    for (std::size_t k = 0; k + 1 < n; ++k) {
        if (side_[k] != side_[k + 1]) {
            one_side = false;
        } else if (cell_.leaves_solid(k)) {
            thin_void = true;
        } else {
            thin_solid = true;
        }
    }
    if (one_side) return cell_.solid;  // never a chord around the other three sides
    if (thin_solid != thin_void) return thin_solid;
    const auto chord = [&](std::size_t a, std::size_t b) {
        const Crossing &p = lattice_.crossings_[border_[a]], &q = lattice_.crossings_[border_[b]];
        const double dx = p.x - q.x, dy = p.y - q.y;
        return std::sqrt(dx * dx + dy * dy);
    };
    double joined = 0, apart = 0;
    for (std::size_t k = 0; k < n; ++k) {
        if (!cell_.leaves_solid(k)) continue;
        joined += chord(k, (k + 1) % n);
        apart += chord(k, (k + n - 1) % n);
    }
    return joined < apart;
}

}  // namespace lamella
