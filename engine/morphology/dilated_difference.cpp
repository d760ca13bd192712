// DilatedDifference: subtracts line after line, nearest first, and stops as soon as nothing is left.
#include "engine/morphology/dilated_difference.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {
namespace {

/// Returns true if any of rows [first, last] has a run. Both may lie outside the rows.
bool any_run(const RunRows& rows, std::ptrdiff_t first, std::ptrdiff_t last) {
    const auto count = static_cast<std::ptrdiff_t>(rows.lines());
    const std::span<const Run> lowest =
                                   rows.line(static_cast<std::size_t>(std::max<std::ptrdiff_t>(first, 0))),
                               highest = rows.line(static_cast<std::size_t>(std::min(last, count - 1)));
    return lowest.data() != highest.data() + highest.size();
}

/// Appends lines [first, last) of the difference. layer_at(k) returns the subtracted layer k layers above, or
/// null.
template <typename LayerAt>
void append_remainder(const RunRows& from, LayerAt layer_at, const BallLines& ball, std::size_t first,
                      std::size_t last, RunRows& out) {
    RunDifference left;
    const auto anything_near = [&](std::ptrdiff_t row) {
        for (int k = -ball.layers(); k <= ball.layers(); ++k) {
            const RunRows* taken = layer_at(k);
            if (taken != nullptr && any_run(*taken, row - ball.rows(), row + ball.rows())) return true;
        }
        return false;
    };
    std::size_t same = first;  // lines from here to l are copied unchanged
    for (std::size_t l = from.line_with_runs(first); l < last; l = from.line_with_runs(l + 1)) {
        if (!anything_near(static_cast<std::ptrdiff_t>(l))) continue;
        out.append_lines(from, same, l - same);
        same = l + 1;
        left.assign(from.line(l));
        for (const BallLines::Line& line : ball.lines()) {
            if (left.empty()) break;
            const RunRows* taken = layer_at(line.layer);
            const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(l) + line.row;
            if (taken == nullptr || row < 0 || row >= static_cast<std::ptrdiff_t>(taken->lines())) continue;
            left.subtract(taken->line(static_cast<std::size_t>(row)), line.reach);
        }
        out.append_line(left.all());
    }
    out.append_lines(from, same, last - same);
}

void check_lines(const RunRows& from, const RunRows& taken) {
    if (from.lines() != taken.lines()) throw FaultError("rows that are taken from others are not as many");
}

}  // namespace

BallLines::BallLines(const LayerLattice& lattice, double radius)
    : layers_(static_cast<int>(lattice.layers_within(radius))),
      rows_(static_cast<int>(lattice.lines_within(radius))) {
    struct Way {
        double squared;
        int layer, row;
    };
    std::vector<Way> ways;
    for (int k = -layers_; k <= layers_; ++k) {
        for (int r = -rows_; r <= rows_; ++r) {
            const double up = k == 0 ? 0 : k * lattice.layer_pitch, across = r * lattice.row_pitch,
                         squared = up * up + across * across;
            if (squared <= radius * radius) ways.push_back({squared, k, r});
        }
    }
    std::ranges::stable_sort(ways, {}, &Way::squared);
    for (const Way& way : ways)
        lines_.push_back({way.layer, way.row, RoundedExtent(std::sqrt(radius * radius - way.squared))});
}

void subtract_dilated(const RunRows& a, const RunRows& b, double radius, double row_pitch, RunRows& out) {
    check_lines(a, b);
    if (a.runs().empty() || b.runs().empty()) {
        out = a;
        return;
    }
    const BallLines disc({row_pitch, infinity, a.lines()}, radius);
    out.clear();
    out.reserve(a.lines(), a.runs().size());
    append_remainder(
        a, [&](int) { return &b; }, disc, 0, a.lines(), out);
}

std::span<const Run> DilatedDifference::difference(const Run& run, std::size_t line, LayersAbout taken,
                                                   const BallLines& ball) {
    left_.assign({&run, 1});
    for (const BallLines::Line& on : ball.lines()) {
        const int layer = on.layer + ball.layers();
        const RunRows* rows = taken[static_cast<std::size_t>(layer)];
        const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(line) + on.row;
        if (rows == nullptr || row < 0 || row >= static_cast<std::ptrdiff_t>(rows->lines())) continue;
        const std::span<const Run> runs = rows->line(static_cast<std::size_t>(row));
        const Run* const end = runs.data() + runs.size();
        const Run* const near = first_ending_behind(runs, left_.all().front().begin - on.reach.ahead);
        if (near == end || near->begin >= left_.all().back().end + on.reach.back) continue;
        left_.subtract({near, end}, on.reach);
        if (left_.empty()) break;
    }
    return left_.all();
}

void DilatedDifferenceStream::push(RunRows from, RunRows taken) {
    check_lines(from, taken);
    layers_.push_back({std::move(from), std::move(taken)});
}

bool DilatedDifferenceStream::pop(RunRows& out) {
    if (layers_.size() < past_ + 1 + (finished_ ? 0 : reach_)) return false;
    const RunRows& from = layers_[past_].from;
    const auto layer_at = [&](int k) {
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(past_) + k;
        const bool is_there = i >= 0 && i < static_cast<std::ptrdiff_t>(layers_.size());
        return is_there ? &layers_[static_cast<std::size_t>(i)].taken : nullptr;
    };
    constexpr std::size_t lines_at_once = 64;
    std::vector<RunRows> strips((from.lines() + lines_at_once - 1) / lines_at_once);
    isolated_parallel_for(strips.size(), [&](std::size_t s) {
        const std::size_t first = s * lines_at_once;
        append_remainder(from, layer_at, ball_, first, std::min(first + lines_at_once, from.lines()),
                         strips[s]);
    });
    std::size_t runs = 0;
    for (const RunRows& strip : strips) runs += strip.runs().size();
    out.clear();
    out.reserve(from.lines(), runs);
    for (const RunRows& strip : strips) out.append_lines(strip);
    layers_[past_].from.clear();
    if (past_ == reach_) {
        layers_.pop_front();
    } else {
        ++past_;
    }
    return true;
}

}  // namespace lamella
