// Set operations on sorted runs, one line at a time.
#include "engine/runs/row_sets.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace lamella {

void unite_line(std::span<const Run> a, std::span<const Run> b, RunRows& out) {
    if (b.empty()) return out.append_line(a);
    if (a.empty()) return out.append_line(b);
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        const Run& next = a[i].begin <= b[j].begin ? a[i++] : b[j++];
        out.push(next.begin, next.end);
    }
    for (; i < a.size(); ++i) out.push(a[i].begin, a[i].end);
    for (; j < b.size(); ++j) out.push(b[j].begin, b[j].end);
    out.end_line();
}

void intersect_line(std::span<const Run> a, std::span<const Run> b, RunRows& out) {
    if (a.size() > b.size()) std::swap(a, b);
    auto next = b.begin();
    for (const Run& run : a) {
        while (next != b.end() && next->end <= run.begin) ++next;
        for (auto other = next; other != b.end() && other->begin < run.end; ++other)
            out.push(std::max(run.begin, other->begin), std::min(run.end, other->end));
    }
    out.end_line();
}

void subtract_line(std::span<const Run> a, std::span<const Run> b, RunRows& out) {
    if (a.empty()) return out.end_line();
    if (b.empty()) return out.append_line(a);
    std::size_t j = 0;
    for (const Run& run : a) {
        std::int32_t from = run.begin;
        while (j < b.size() && b[j].end <= from) ++j;
        for (std::size_t k = j; k < b.size() && b[k].begin < run.end; ++k) {
            out.push(from, b[k].begin);
            from = std::max(from, b[k].end);
        }
        out.push(from, run.end);
    }
    out.end_line();
}

namespace {

/// Returns the first line from `l` on where both have runs; the number of lines when there is none.
std::size_t line_with_both(const RunRows& a, const RunRows& b, std::size_t l) {
    for (const std::size_t lines = a.lines();;) {
        const std::size_t of_a = a.line_with_runs(l);
        if (of_a == lines) return lines;
        l = b.line_with_runs(of_a);
        if (l == of_a || l == lines) return l;
    }
}

}  // namespace

// Often only few lines have runs in both operands. All others are skipped or copied in bulk.

void unite(const RunRows& a, const RunRows& b, RunRows& out) {
    const bool a_has_more = a.runs().size() >= b.runs().size();
    const RunRows &most = a_has_more ? a : b, &others = a_has_more ? b : a;
    assert(a.lines() == b.lines() && &out != &a && &out != &b);
    out.clear();
    out.reserve(a.lines(), a.runs().size() + b.runs().size());
    for (std::size_t l = others.line_with_runs(0); l < a.lines(); l = others.line_with_runs(l + 1)) {
        out.append_lines(most, out.lines(), l - out.lines());
        unite_line(most.line(l), others.line(l), out);
    }
    out.append_lines(most, out.lines(), a.lines() - out.lines());
}

void intersect(const RunRows& a, const RunRows& b, RunRows& out) {
    assert(a.lines() == b.lines() && &out != &a && &out != &b);
    out.clear();
    out.reserve(a.lines(), std::min(a.runs().size(), b.runs().size()));
    for (std::size_t l = line_with_both(a, b, 0); l < a.lines(); l = line_with_both(a, b, l + 1)) {
        out.end_lines(l - out.lines());
        intersect_line(a.line(l), b.line(l), out);
    }
    out.end_lines(a.lines() - out.lines());
}

void subtract(const RunRows& a, const RunRows& b, RunRows& out) {
    assert(a.lines() == b.lines() && &out != &a && &out != &b);
    out.clear();
    out.reserve(a.lines(), a.runs().size());
    for (std::size_t l = line_with_both(a, b, 0); l < a.lines(); l = line_with_both(a, b, l + 1)) {
        out.append_lines(a, out.lines(), l - out.lines());
        subtract_line(a.line(l), b.line(l), out);
    }
    out.append_lines(a, out.lines(), a.lines() - out.lines());
}

}  // namespace lamella
