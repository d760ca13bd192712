// Set operations on sorted runs, one line at a time.
#include "engine/row_sets.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace lamella {

void unite_line(std::span<const Run> a, std::span<const Run> b, SpanRows& out) {
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

void intersect_line(std::span<const Run> a, std::span<const Run> b, SpanRows& out) {
    if (a.size() > b.size()) std::swap(a, b);
    auto next = b.begin();
    for (const Run& run : a) {
        while (next != b.end() && next->end <= run.begin) ++next;
        for (auto other = next; other != b.end() && other->begin < run.end; ++other)
            out.push(std::max(run.begin, other->begin), std::min(run.end, other->end));
    }
    out.end_line();
}

void subtract_line(std::span<const Run> a, std::span<const Run> b, SpanRows& out) {
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

template <typename LineOperation>
void line_by_line(const SpanRows& a, const SpanRows& b, SpanRows& out, std::size_t runs,
                  LineOperation operation) {
    assert(a.lines() == b.lines() && &out != &a && &out != &b);
    out.clear();
    out.reserve(a.lines(), runs);
    for (std::size_t l = 0; l < a.lines(); ++l) {
        if (a.line(l).empty() && b.line(l).empty()) {
            out.end_line();
        } else {
            operation(a.line(l), b.line(l), out);
        }
    }
}

}  // namespace

void unite(const SpanRows& a, const SpanRows& b, SpanRows& out) {
    if (a.runs().empty() || b.runs().empty()) {
        out = a.runs().empty() ? b : a;
    } else {
        line_by_line(a, b, out, a.runs().size() + b.runs().size(), unite_line);
    }
}

void intersect(const SpanRows& a, const SpanRows& b, SpanRows& out) {
    line_by_line(a, b, out, std::min(a.runs().size(), b.runs().size()), intersect_line);
}

void subtract(const SpanRows& a, const SpanRows& b, SpanRows& out) {
    if (a.runs().empty() || b.runs().empty()) {
        out = a;
    } else {
        line_by_line(a, b, out, a.runs().size(), subtract_line);
    }
}

}  // namespace lamella
