// Walks intervals of many lines in step and evaluates all their next points in one batch.
#include "procedural/lattice/line_walk.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace lamella {
namespace {

constexpr double stretch = 16 * run_unit;
constexpr double smallest_step = run_unit / 4.0;
constexpr double precise = 1.0 / 64;  // run units
constexpr int max_rounds = 16;
/// Points per batch: enough to amortise the cost of a call.
constexpr std::size_t many_points = 1 << 14;

/// Two neighbouring points of a line, and the values there.
struct Pair {
    std::size_t line;
    double u0, v0, u1, v1;

    bool turns() const { return (v0 < 0) != (v1 < 0); }
    double gap() const { return u1 - u0; }
    double middle() const { return (u0 + u1) * 0.5; }
};

/// A pair with a sign change between its points, under refinement.
class Turn {
  public:
    explicit Turn(const Pair& pair) : pair_(pair), weight0_(pair.v0), weight1_(pair.v1) {}

    std::size_t line() const { return pair_.line; }
    double begin() const { return pair_.u0; }
    bool into_solid() const { return !(pair_.v0 < 0); }
    bool is_found() const { return found_ || pair_.gap() <= precise; }
    double at() const { return found_ ? at_ : pair_.middle(); }

    /// Returns the next point to evaluate: by false position (Illinois) while that converges, else by
    /// bisection.
    double next(int round) {
        slope_ = (pair_.v1 - pair_.v0) / pair_.gap();
        const double between = pair_.u0 + pair_.gap() * (weight0_ / (weight0_ - weight1_));
        halves_ = round % 8 == 7 || !(pair_.u0 < between && between < pair_.u1);
        at_ = halves_ ? pair_.middle() : between;
        return at_;
    }
    void take(double value) {
        found_ = !halves_ && std::abs(value) < precise * std::abs(slope_);
        if (found_) return;
        // The weight of an end that stays twice is halved, so that the next point falls beyond the root.
        if ((value < 0) == (pair_.v0 < 0)) {
            pair_.u0 = at_;
            weight0_ = pair_.v0 = value;
            weight1_ = kept_ == 1 ? weight1_ / 2 : pair_.v1;
            kept_ = 1;
        } else {
            pair_.u1 = at_;
            weight1_ = pair_.v1 = value;
            weight0_ = kept_ == 0 ? weight0_ / 2 : pair_.v0;
            kept_ = 0;
        }
    }

  private:
    Pair pair_;
    double weight0_, weight1_;  // of the ends
    double at_ = 0, slope_ = 0;
    int kept_ = -1;  // which end stayed at the last step
    bool halves_ = false, found_ = false;
};

/// Walks the lines [first, last).
class ValueWalk {
  public:
    ValueWalk(const LineFunction& function, std::size_t first, std::size_t last, std::int32_t lo,
              std::int32_t hi)
        : function_(function), first_(first), last_(last), lo_(lo), hi_(hi) {
        for (std::size_t line = first; line < last; ++line) steepest_.push_back(function.steepest(line));
    }

    void run(RunRows& out) {
        evaluate_stretches();
        found_in_stretches_ = turns_.size();
        while (!pairs_.empty()) halve();
        sort_turns();
        narrow();
        append(out);
    }

  private:
    void evaluate() {
        values_.resize(points_.size());
        function_.values(points_, values_);
    }

    void evaluate_stretches() {
        const double begin = std::floor(static_cast<double>(lo_) / stretch) * stretch;
        points_.clear();
        for (std::size_t line = first_; line < last_; ++line) {
            points_.push_back({line, begin});
            for (double u = begin; u < hi_; u += stretch) points_.push_back({line, u + stretch});
        }
        evaluate();
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const LinePoint& point = points_[i];
            if (i == 0 || points_[i - 1].line != point.line) {
                begins_solid_.push_back(values_[i] < 0);
            } else {
                consider({point.line, points_[i - 1].u, values_[i - 1], point.u, values_[i]});
            }
        }
    }

    /// Keeps a pair if there is, or may be, a sign change between its points.
    void consider(const Pair& pair) {
        const bool turns = pair.turns();
        if (!turns && is_proven(pair)) return;
        if (pair.gap() > smallest_step && !function_.is_monotone(pair.line, pair.u0, pair.u1)) {
            pairs_.push_back(pair);
        } else if (turns) {
            turns_.emplace_back(pair);
        }
    }

    /// Returns whether there is certainly no sign change between two points on one side; false if a value is
    /// NaN.
    bool is_proven(const Pair& pair) const {
        return std::abs(pair.v0) + std::abs(pair.v1) >= steepest_[pair.line - first_] * pair.gap();
    }

    /// Those found in whole stretches are in order, and most of all.
    void sort_turns() {
        const auto place = [](const Turn& turn) { return std::pair(turn.line(), turn.begin()); };
        const auto rest = turns_.begin() + static_cast<std::ptrdiff_t>(found_in_stretches_);
        std::ranges::sort(rest, turns_.end(), {}, place);
        std::ranges::inplace_merge(turns_.begin(), rest, turns_.end(), {}, place);
    }

    void halve() {
        points_.clear();
        for (const Pair& pair : pairs_) points_.push_back({pair.line, pair.middle()});
        evaluate();
        std::swap(pairs_, wholes_);
        pairs_.clear();
        for (std::size_t i = 0; i < wholes_.size(); ++i) {
            const auto& [line, u0, v0, u1, v1] = wholes_[i];
            consider({line, u0, v0, points_[i].u, values_[i]});
            consider({line, points_[i].u, values_[i], u1, v1});
        }
    }

    void narrow() {
        std::vector<Turn*> open;
        for (Turn& turn : turns_) open.push_back(&turn);
        for (int round = 0; round < max_rounds; ++round) {
            std::erase_if(open, [](const Turn* turn) { return turn->is_found(); });
            if (open.empty()) return;
            points_.clear();
            for (Turn* const turn : open) points_.push_back({turn->line(), turn->next(round)});
            evaluate();
            for (std::size_t i = 0; i < open.size(); ++i) open[i]->take(values_[i]);
        }
    }

    void append(RunRows& out) const {
        std::size_t next = 0;
        for (std::size_t line = first_; line < last_; ++line) {
            std::int32_t begin = lo_;
            bool solid = begins_solid_[line - first_];
            for (; next < turns_.size() && turns_[next].line() == line; ++next) {
                const std::int32_t at = round_run(turns_[next].at());
                if (solid) out.push(std::max(begin, lo_), std::min(at, hi_));
                begin = at;
                solid = turns_[next].into_solid();
            }
            if (solid) out.push(std::max(begin, lo_), hi_);
            out.end_line();
        }
    }

    const LineFunction& function_;
    std::size_t first_, last_;
    std::int32_t lo_, hi_;
    std::vector<double> steepest_;  // of the lines
    std::vector<LinePoint> points_;
    std::vector<double> values_;
    std::vector<bool> begins_solid_;
    std::vector<Pair> pairs_;   // with possible sign changes between their points
    std::vector<Pair> wholes_;  // the pairs that pairs_ are halves of
    std::vector<Turn> turns_;
    std::size_t found_in_stretches_ = 0;
};

}  // namespace

void walk_lines(const LineFunction& function, std::size_t lines, std::int32_t lo, std::int32_t hi,
                RunRows& out) {
    const double length = std::max(0.0, static_cast<double>(hi) - lo);
    const auto borders = static_cast<std::size_t>(length / stretch) + 2;
    const std::size_t at_once = std::max<std::size_t>(1, many_points / borders);
    for (std::size_t first = 0; first < lines; first += at_once)
        ValueWalk(function, first, std::min(first + at_once, lines), lo, hi).run(out);
}

}  // namespace lamella
