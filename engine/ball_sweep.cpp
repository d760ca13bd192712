// Aging, cutting, and forgetting what lies hidden.
#include "engine/ball_sweep.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

constexpr std::size_t few = 8;
constexpr int neighbours = 4;  // that are asked on either side
/// By how much parts must overlap to count as meeting, run units: rounding shall drop nothing.
constexpr double surely = 1e-5;

}  // namespace

void BallSweep::reset() {
    line_ = 0;
    kept_ = 0;
    active_.clear();
}

void BallSweep::step() {
    if (active_.size() > kept_ + kept_ / 2 + few) drop_hidden();
    ++line_;
    std::size_t kept = 0;
    for (const Active& old : active_) {
        const double way = (line_ - old.line) * pitch_, left = old.weight - way * way;
        if (left < 0) continue;
        Active& a = active_[kept++] = old;
        a.left = left;
        a.reach = std::sqrt(left);
    }
    active_.resize(kept);
}

bool BallSweep::before(const Active& a, const Active& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
}

/// Takes what lies in a run out of those that are no later and no higher. What lies left of all runs to come
/// is passed by for good: `first` moves along.
void BallSweep::cut_out(const Active& later, std::size_t& first) {
    while (first < active_.size() && active_[first].end <= later.begin) ++first;
    for (std::size_t i = first; i < active_.size(); ++i) {
        Active& a = active_[i];
        if (a.begin >= later.end) return;  // cuts move begins up, but not beyond the run that cuts
        if (a.end <= later.begin || a.left > later.left) continue;
        const bool sticks_out_left = a.begin < later.begin, sticks_out_right = later.end < a.end;
        if (sticks_out_left && sticks_out_right) {
            fresh_.push_back(a);
            fresh_.back().begin = later.end;
        }
        if (sticks_out_left) {
            a.end = later.begin;
        } else if (sticks_out_right) {
            a.begin = later.end;
        } else {
            a.hidden = true;
        }
    }
}

void BallSweep::add(std::span<const BallRun> runs) {
    if (runs.empty()) return;
    fresh_.clear();
    std::size_t first = 0;
    for (const BallRun& run : runs) {
        const Active a{std::sqrt(run.weight), run.weight, run.weight, run.begin, run.end, line_, false};
        cut_out(a, first);
        fresh_.push_back(a);
    }
    // What a cut leaves on the right may be cut by a run farther right.
    std::ranges::sort(fresh_, before);
    std::erase_if(active_, [](const Active& a) { return a.hidden; });
    if (!std::ranges::is_sorted(active_, before)) std::ranges::sort(active_, before);
    merged_.resize(active_.size() + fresh_.size());
    std::ranges::merge(active_, fresh_, merged_.begin(), before);
    active_.swap(merged_);
}

/// Up to where a run is below one that begins and ends no farther right; the latter's end is the origin.
/// `gain` is what the square of its reach is more.
double BallSweep::below_left(double begin, double end, double gain) {
    // Left of the run's begin both heights fall off, within it one, right of its end both.
    if (begin > 0 && gain < begin * begin) return (gain + begin * begin) / (2 * begin);
    if (gain < 0) return -infinity;
    if (gain < end * end) return std::sqrt(gain);
    return end > 0 ? (gain + end * end) / (2 * end) : infinity;
}

bool BallSweep::is_hidden(std::size_t i) const {
    const Active& a = active_[i];
    double up_to = a.begin - a.reach, from = a.end + a.reach;
    const double lo = up_to, hi = from;
    const auto ask = [&](const Active& other) {
        if (other.line < a.line) return false;
        const bool left = other.begin <= a.begin && other.end <= a.end;
        const bool right = other.begin >= a.begin && other.end >= a.end;
        const double gain = other.left - a.left;
        if (left) {
            const double to_begin = double(a.begin) - other.end, to_end = double(a.end) - other.end;
            up_to = std::max(up_to, other.end + below_left(to_begin, to_end, gain));
        }
        if (right) {
            const double to_begin = double(other.begin) - a.begin, to_end = double(other.begin) - a.end;
            from = std::min(from, other.begin - below_left(to_end, to_begin, gain));
        }
        if (!left && !right) {  // one within the other
            if (other.left < a.left) return false;
            return other.begin - other.reach <= lo && other.end + other.reach >= hi;
        }
        return up_to >= from + surely || up_to >= hi + surely || from <= lo - surely;
    };
    int asked = 0;
    for (std::size_t k = i; k-- > 0 && asked < neighbours;) {
        if (active_[k].hidden) continue;
        ++asked;
        if (ask(active_[k])) return true;
    }
    asked = 0;
    for (std::size_t k = i + 1; k < active_.size() && asked < neighbours; ++k, ++asked) {
        if (ask(active_[k])) return true;
    }
    return false;
}

void BallSweep::drop_hidden() {
    for (std::size_t i = 0; i < active_.size(); ++i) active_[i].hidden = is_hidden(i);
    std::erase_if(active_, [](const Active& a) { return a.hidden; });
    kept_ = active_.size();
}

void BallSweep::append_covered(std::vector<Run>& out) const {
    for (const Active& a : active_) {
        const BallReach reach(a.reach);
        out.push_back({a.begin - reach.back, a.end + reach.ahead});
    }
}

void BallSweep::append_runs(std::vector<BallRun>& out) const {
    for (const Active& a : active_) out.push_back({a.begin, a.end, a.left});
}

}  // namespace lamella
