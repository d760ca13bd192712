// Rows from pixels, and how far what is solid in one layer lies from what holds it: by brute force.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/runs/runs.h"

namespace lamella::test {

/// Sampled along lines at a sixteenth of a pixel; lines at whole numbers.
template <typename Solid>
RunRows rows_where(int lines, int width, Solid solid) {
    RunRows rows;
    for (int l = 0; l < lines; ++l) {
        for (int x = 0; x < width * 16; ++x) {
            if (solid((x + 0.5) / 16, l)) rows.push(x * 16, x * 16 + 16);
        }
        rows.end_line();
    }
    return rows;
}

inline bool holds(std::span<const Run> line, std::int32_t u) {
    return std::any_of(line.begin(), line.end(), [&](const Run& r) { return r.begin <= u && u < r.end; });
}

/// Distance along a line from a place to the nearest one outside its runs.
inline double way_out(std::span<const Run> line, std::int32_t u) {
    for (const Run& run : line) {
        if (run.begin <= u && u < run.end) return std::min(u - run.begin + 1, run.end - u);
    }
    return 0;
}

/// The greatest distance, run units, from a place in one layer to the nearest in the other; looked at in
/// every line, at its runs' ends and between them.
inline double furthest_from(const RunRows& layer, const RunRows& other, double row_pitch) {
    double furthest = 0;
    const int lines = static_cast<int>(layer.lines());
    for (int l = 0; l < lines; ++l) {
        for (const Run& run : layer.line(static_cast<std::size_t>(l))) {
            for (std::int32_t u = run.begin; u < run.end; u += 7) {
                double nearest = std::numeric_limits<double>::infinity();
                for (int k = 0; k < lines; ++k) {
                    const double across = (k - l) * row_pitch;
                    for (const Run& there : other.line(static_cast<std::size_t>(k))) {
                        const double along = std::max({there.begin - u, u - there.end + 1, 0});
                        nearest = std::min(nearest, std::hypot(along, across));
                    }
                }
                furthest = std::max(furthest, nearest);
            }
        }
    }
    return furthest;
}

/// The greatest distance, run units, from a place that is not in `above` to the nearest that is not in
/// `cavity`, both in layers one over the other; looked at in every line, at its runs' ends and between them.
inline double furthest_overhang(const RunRows& cavity, const RunRows& above, double row_pitch) {
    double furthest = 0;
    const int lines = static_cast<int>(cavity.lines());
    for (int l = 0; l < lines; ++l) {
        for (const Run& run : cavity.line(static_cast<std::size_t>(l))) {
            for (std::int32_t u = run.begin; u < run.end; u += 7) {
                if (holds(above.line(static_cast<std::size_t>(l)), u)) continue;
                double nearest = std::numeric_limits<double>::infinity();
                for (int k = -1; k <= lines; ++k) {
                    const double across = (k - l) * row_pitch;
                    if (std::abs(across) >= nearest) continue;
                    const bool beyond = k < 0 || k >= lines;
                    const double along = beyond ? 0 : way_out(cavity.line(static_cast<std::size_t>(k)), u);
                    nearest = std::min(nearest, std::hypot(along, across));
                }
                furthest = std::max(furthest, nearest);
            }
        }
    }
    return furthest;
}

}  // namespace lamella::test
