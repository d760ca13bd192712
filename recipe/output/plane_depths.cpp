// A straight border at distances a along the row and b along the column is a b / sqrt(a^2 + b^2) away.
#include "recipe/output/plane_depths.h"

#include <array>
#include <cstring>

namespace lamella {
namespace {

constexpr std::int32_t reach_in_runs = depth_reach * run_unit;
constexpr std::int32_t to_centre = run_unit / 2;

/// Converts a length in run units, 0 or more, to a depth.
int depth_of(std::int32_t length) {
    constexpr int runs_per_depth = run_unit / depth_unit;
    return std::clamp((length + runs_per_depth / 2) / runs_per_depth, 1, full_depth);
}

/// Sets the depths of the cells of a gap between runs near its ends; those farther away are set already.
void fill_gap(std::int32_t begin, std::int32_t end, int count, std::int8_t* depths) {
    const auto set = [&](int cell) {
        const std::int32_t centre = cell * run_unit + to_centre;
        depths[cell] = static_cast<std::int8_t>(-depth_of(std::min(centre - begin, end - centre)));
    };
    // The first centre not before `begin`, and the first not before `end`.
    const int first = std::max((begin + to_centre - 1) / run_unit, 0);
    const int last = std::min((end + to_centre - 1) / run_unit, count);
    const int after = std::min(last, first + depth_reach);
    for (int cell = first; cell < after; ++cell) set(cell);
    for (int cell = std::max(after, last - depth_reach); cell < last; ++cell) set(cell);
}

void fill_run(const Run& run, int count, std::int8_t* depths) {
    const int first = std::max((run.begin + to_centre - 1) / run_unit, 0);
    const int last = std::min((run.end + to_centre - 1) / run_unit, count);
    const auto set = [&](int cell) {
        const std::int32_t centre = cell * run_unit + to_centre;
        depths[cell] = static_cast<std::int8_t>(depth_of(std::min(centre - run.begin, run.end - centre)));
    };
    const int after = std::min(last, first + depth_reach), before = std::max(after, last - depth_reach);
    for (int cell = first; cell < after; ++cell) set(cell);
    if (before > after) std::memset(depths + after, full_depth, static_cast<std::size_t>(before - after));
    for (int cell = before; cell < last; ++cell) set(cell);
}

/// Makes every run wide enough that what is thinner has no holes, whatever its direction.
void widen(std::span<const Run> runs, std::vector<Run>& wide) {
    wide.clear();
    for (const Run& run : runs) {
        constexpr std::int32_t least = run_unit * 7 / 4;
        const std::int32_t missing = std::max(least - (run.end - run.begin), 0);
        const Run wider{run.begin - missing / 2, run.end + (missing + 1) / 2};
        if (!wide.empty() && wider.begin <= wide.back().end) {
            wide.back().end = std::max(wide.back().end, wider.end);
        } else {
            wide.push_back(wider);
        }
    }
}

/// Sets the depths of a line of `count` cells along itself.
void fill_line(std::span<const Run> lines, int count, std::vector<Run>& runs, std::int8_t* depths) {
    widen(lines, runs);
    std::memset(depths, -full_depth, static_cast<std::size_t>(count));
    constexpr std::int32_t far = 2 * reach_in_runs;
    const std::int32_t end = count * run_unit;
    std::int32_t gap = -far;  // begin of the gap before the next run
    for (const Run& run : runs) {
        fill_gap(gap, run.begin, count, depths);
        gap = run.end;
    }
    if (!runs.empty()) fill_gap(gap, end + far, count, depths);
    for (const Run& run : runs) fill_run(run, count, depths);
}

using DepthTable = std::array<std::array<std::int8_t, full_depth + 1>, full_depth + 1>;

/// The distance from a straight border by its distances along and across.
const DepthTable& oblique() {
    static const DepthTable table = [] {
        DepthTable made{};
        for (int a = 1; a <= full_depth; ++a) {
            for (int b = 1; b <= full_depth; ++b) {
                // At full depth the border may be anywhere beyond.
                const double x = a == full_depth ? 1e9 : a, y = b == full_depth ? 1e9 : b;
                made[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] =
                    static_cast<std::int8_t>(std::clamp(
                        static_cast<int>(std::lround(x * y / std::hypot(x, y) - 1e-9)), 1, full_depth));
            }
        }
        return made;
    }();
    return table;
}

std::int8_t depth_at(std::int8_t along, std::int8_t across, const DepthTable& table) {
    // A thin run may be seen in one direction only.
    if ((along > 0) != (across > 0)) return std::max(along, across);
    const std::int8_t depth =
        table[static_cast<std::size_t>(std::abs(along))][static_cast<std::size_t>(std::abs(across))];
    return along > 0 ? depth : static_cast<std::int8_t>(-depth);
}

}  // namespace

PlaneDepths::PlaneDepths(int columns, int rows) : columns_(columns), rows_(rows) {
    const std::size_t area = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    along_.resize(area);
    across_.resize(area);
    uniform_.resize(static_cast<std::size_t>(columns) * (static_cast<std::size_t>(rows + 7) / 8));
    steep_.resize(area);
    depths_.resize(area);
}

void PlaneDepths::set(const RunRows& rows, const RunRows& columns) {
    for (int y = 0; y < rows_; ++y)
        fill_line(rows.line(static_cast<std::size_t>(y)), columns_, runs_, &along_[at(0, y)]);
    for (int x = 0; x < columns_; ++x) {
        fill_line(columns.line(static_cast<std::size_t>(x)), rows_, runs_,
                  &across_[static_cast<std::size_t>(x) * static_cast<std::size_t>(rows_)]);
    }
    for (int x = 0; x < columns_; ++x) find_uniform(x);
    for (int y = 0; y < rows_; ++y) combine(y);
    for (int y = 0; y < rows_; ++y) limit_steps(y);
}

/// Marks the blocks of eight cells of a column that are all far inside or all far outside.
void PlaneDepths::find_uniform(int x) {
    const std::int8_t* const column = &across_[static_cast<std::size_t>(x) * static_cast<std::size_t>(rows_)];
    for (int y = 0; y < rows_; y += 8) {
        const bool whole = y + 8 <= rows_ && (column[y] == full_depth || column[y] == -full_depth) &&
                           std::memcmp(column + y, column + y + 1, 7) == 0;
        uniform_[at(x, y >> 3)] = whole ? column[y] : std::int8_t{0};
    }
}

void PlaneDepths::combine(int y) {
    const DepthTable& table = oblique();
    const std::int8_t* const along = &along_[at(0, y)];
    const std::int8_t* const uniform = &uniform_[at(0, y >> 3)];
    const std::int8_t* const across = &across_[static_cast<std::size_t>(y)];
    std::uint8_t* const out = &steep_[at(0, y)];
    const auto set = [&](int x) {
        const std::int8_t depth = depth_at(along[x], across[std::ptrdiff_t{x} * rows_], table);
        out[x] = static_cast<std::uint8_t>(surface_depth + depth);
    };
    int x = 0;
    for (; x + 8 <= columns_; x += 8) {
        // Equal to the columns, which are far from their borders: so are the cells.
        if (std::memcmp(along + x, uniform + x, 8) == 0) {
            for (int i = x; i < x + 8; ++i) out[i] = static_cast<std::uint8_t>(along[i] + surface_depth);
        } else {
            for (int i = x; i < x + 8; ++i) set(i);
        }
    }
    for (; x < columns_; ++x) set(x);
}

/// Neighbours differ by at most a cell: lines that miss the solid beside a corner know nothing of its
/// distance.
void PlaneDepths::limit_steps(int y) {
    const auto columns = static_cast<std::size_t>(columns_);
    const std::uint8_t* const here = &steep_[at(0, y)];
    const std::uint8_t* const below = y > 0 ? here - columns : here;
    const std::uint8_t* const above = y + 1 < rows_ ? here + columns : here;
    std::uint8_t* const out = &depths_[at(0, y)];
    out[0] = here[0];
    out[columns - 1] = here[columns - 1];
    using Byte = std::uint8_t;
    for (std::size_t x = 1; x + 1 < columns; ++x) {
        const Byte most = std::max(std::max(here[x - 1], here[x + 1]), std::max(below[x], above[x]));
        const Byte least = std::min(std::min(here[x - 1], here[x + 1]), std::min(below[x], above[x]));
        // In 8 bits: max(most - unit, 0), and min(least + unit, 255).
        const Byte lower = static_cast<Byte>(std::max(most, Byte{depth_unit}) - depth_unit);
        const Byte upper = static_cast<Byte>(std::min(least, Byte{255 - depth_unit}) + depth_unit);
        const Byte outside = std::max(here[x], std::min(lower, Byte{surface_depth - 1}));
        const Byte inside = std::min(here[x], std::max(upper, Byte{surface_depth + 1}));
        out[x] = here[x] < surface_depth ? outside : inside;
    }
}

}  // namespace lamella
