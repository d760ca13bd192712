// Line by line, the nearest ones first, as long as anything is left.
#include "engine/layer_remainder.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/parallel_strips.h"

namespace lamella {
namespace {

/// Takes runs that reach further to both sides out of sorted ones. The buffer is for what is left.
void take_away(std::span<const Run> taken, const BallReach& reach, std::vector<Run>& runs,
               std::vector<Run>& buffer) {
    const Run *t = taken.data(), *const end = t + taken.size();
    while (t != end && t->end + reach.ahead <= runs.front().begin) ++t;
    if (t == end || t->begin - reach.back >= runs.back().end) return;
    buffer.resize(runs.size() + static_cast<std::size_t>(end - t));
    Run* left = buffer.data();
    for (const Run& run : runs) {
        while (t != end && t->end + reach.ahead <= run.begin) ++t;
        std::int32_t from = run.begin;
        for (const Run* cut = t; cut != end && cut->begin - reach.back < run.end; ++cut) {
            if (cut->begin - reach.back > from) *left++ = {from, cut->begin - reach.back};
            from = std::max(from, cut->end + reach.ahead);
        }
        if (from < run.end) *left++ = {from, run.end};
    }
    buffer.resize(static_cast<std::size_t>(left - buffer.data()));
    runs.swap(buffer);
}

/// Appends lines [first, last) of what is left. layer_at(k) is what is grown k layers on, or null.
template <typename LayerAt>
void append_remainder(const SpanRows& from, LayerAt layer_at, const BallLines& ball, std::size_t first,
                      std::size_t last, SpanRows& out) {
    std::vector<Run> left, buffer;
    for (std::size_t l = first; l < last; ++l) {
        left.assign(from.line(l).begin(), from.line(l).end());
        for (const BallLines::Line& line : ball.lines()) {
            if (left.empty()) break;
            const SpanRows* taken = layer_at(line.layer);
            const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(l) + line.row;
            if (taken == nullptr || row < 0 || row >= static_cast<std::ptrdiff_t>(taken->lines())) continue;
            take_away(taken->line(static_cast<std::size_t>(row)), line.reach, left, buffer);
        }
        out.append_line(left);
    }
}

void check_lines(const SpanRows& from, const SpanRows& taken) {
    if (from.lines() != taken.lines()) throw FaultError("rows that are taken from others are not as many");
}

}  // namespace

BallLines::BallLines(const LayerLattice& lattice, double radius) {
    struct Way {
        double squared;
        int layer, row;
    };
    std::vector<Way> ways;
    const int layers = static_cast<int>(lattice.layers_within(radius)),
              rows = static_cast<int>(lattice.lines_within(radius));
    for (int k = -layers; k <= layers; ++k) {
        for (int r = -rows; r <= rows; ++r) {
            const double up = k == 0 ? 0 : k * lattice.layer_pitch, across = r * lattice.row_pitch,
                         squared = up * up + across * across;
            if (squared <= radius * radius) ways.push_back({squared, k, r});
        }
    }
    std::ranges::stable_sort(ways, {}, &Way::squared);
    for (const Way& way : ways)
        lines_.push_back({way.layer, way.row, BallReach(std::sqrt(radius * radius - way.squared))});
}

void subtract_grown(const SpanRows& a, const SpanRows& b, double radius, double row_pitch, SpanRows& out) {
    check_lines(a, b);
    const BallLines disc({row_pitch, infinity, a.lines()}, radius);
    out.clear();
    append_remainder(
        a, [&](int) { return &b; }, disc, 0, a.lines(), out);
}

void RemainingLayers::push(SpanRows from, SpanRows taken) {
    check_lines(from, taken);
    layers_.push_back({std::move(from), std::move(taken)});
}

bool RemainingLayers::pop(SpanRows& out) {
    if (layers_.size() < past_ + 1 + (finished_ ? 0 : reach_)) return false;
    const SpanRows& from = layers_[past_].from;
    const auto layer_at = [&](int k) {
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(past_) + k;
        const bool is_there = i >= 0 && i < static_cast<std::ptrdiff_t>(layers_.size());
        return is_there ? &layers_[static_cast<std::size_t>(i)].taken : nullptr;
    };
    constexpr std::size_t lines_at_once = 64;
    std::vector<SpanRows> strips((from.lines() + lines_at_once - 1) / lines_at_once);
    for_all_strips(strips.size(), [&](std::size_t s) {
        const std::size_t first = s * lines_at_once;
        append_remainder(from, layer_at, ball_, first, std::min(first + lines_at_once, from.lines()),
                         strips[s]);
    });
    out.clear();
    for (const SpanRows& strip : strips) {
        for (std::size_t l = 0; l < strip.lines(); ++l) out.append_line(strip.line(l));
    }
    layers_[past_].from.clear();
    if (past_ == reach_) {
        layers_.pop_front();
    } else {
        ++past_;
    }
    return true;
}

}  // namespace lamella
