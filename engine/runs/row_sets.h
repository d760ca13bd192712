// Set operations on the runs of a layer that return their result, for callers without a buffer.
#pragma once

#include <algorithm>

#include "engine/runs/runs.h"

namespace lamella {

/// Appends the result of the operation for one line.
void unite_line(std::span<const Run> a, std::span<const Run> b, RunRows& out);
void intersect_line(std::span<const Run> a, std::span<const Run> b, RunRows& out);
void subtract_line(std::span<const Run> a, std::span<const Run> b, RunRows& out);

/// Return the result of the operation line by line; the operands have equally many lines.
inline RunRows united(const RunRows& a, const RunRows& b) {
    RunRows out;
    unite(a, b, out);
    return out;
}
inline RunRows common(const RunRows& a, const RunRows& b) {
    RunRows out;
    intersect(a, b, out);
    return out;
}
inline RunRows without(const RunRows& a, const RunRows& b) {
    RunRows out;
    subtract(a, b, out);
    return out;
}
/// Returns, for each line, the part of [begin, end) that `rows` leaves; all runs of `rows` lie in [begin,
/// end).
inline RunRows complement(const RunRows& rows, std::int32_t begin, std::int32_t end) {
    RunRows out;
    out.reserve(rows.lines(), rows.lines() + rows.runs().size());
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        std::int32_t from = begin;
        for (const Run& run : rows.line(l)) {
            out.push(from, run.begin);
            from = run.end;
        }
        out.push(from, end);
        out.end_line();
    }
    return out;
}
/// Returns the interval from the first begin to the last end of any line's runs; {0, 0} when there are none.
inline Run extent_of(const RunRows& rows) {
    Run extent{0, 0};
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        if (rows.line(l).empty()) continue;
        const std::int32_t begin = rows.line(l).front().begin, end = rows.line(l).back().end;
        extent = extent.begin == extent.end ? Run{begin, end}
                                            : Run{std::min(extent.begin, begin), std::max(extent.end, end)};
    }
    return extent;
}
/// Returns rows without a run.
inline RunRows empty_rows(std::size_t lines) {
    RunRows out;
    out.end_lines(lines);
    return out;
}

}  // namespace lamella
