// The line walk: runs along one line of a function whose steepness is known, by halving what is not proven.
#pragma once

#include <cmath>

#include "engine/runs.h"

namespace lamella {

/// Finds where value(u) < 0 for run coordinates u, and appends it to `out` as one line of runs within [lo,
/// hi). Stretches of 8 pixels are halved until the values at both ends prove that nothing turns between them,
/// or down to a quarter pixel. `steepest` is the largest change of value per run unit. The stretches lie at
/// whole multiples of their length, so a run does not depend on where the line begins. NaN is outside.
template <typename Value>
class LineWalk {
  public:
    LineWalk(const Value& value, double steepest, std::int32_t lo, std::int32_t hi, SpanRows& out)
        : value_(value), steepest_(steepest), lo_(lo), hi_(hi), out_(out) {}

    void walk() {
        const double first = std::floor(static_cast<double>(lo_) / stretch) * stretch;
        double u = first, v = value_(u);
        if (v < 0) begin_ = lo_;
        while (u < hi_) {
            const double next = u + stretch, at_next = value_(next);
            search(u, v, next, at_next);
            u = next;
            v = at_next;
        }
        if (begin_ != none) push(hi_);
        out_.end_line();
    }

  private:
    static constexpr double stretch = 8 * run_unit;
    static constexpr double least = run_unit / 4.0;
    static constexpr double precise = 1.0 / 64;  // run units
    static constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();

    void search(double u0, double v0, double u1, double v1) {
        const bool in0 = v0 < 0, in1 = v1 < 0;
        const double gap = u1 - u0;
        if (in0 == in1) {
            if (gap <= least || std::abs(v0) + std::abs(v1) >= steepest_ * gap) return;
        } else if (gap <= least) {
            return turn(round_run(crossing(u0, v0, u1, v1)), in1);
        }
        const double middle = (u0 + u1) * 0.5, v = value_(middle);
        search(u0, v0, middle, v);
        search(middle, v, u1, v1);
    }

    /// Secant steps while they close in, halvings otherwise.
    double crossing(double u0, double v0, double u1, double v1) const {
        const bool in0 = v0 < 0;
        for (int i = 0; i < 16 && u1 - u0 > precise; ++i) {
            const double slope = (v1 - v0) / (u1 - u0), secant = u0 - v0 / slope;
            const bool halve = i % 3 == 2 || !(u0 < secant && secant < u1);
            const double u = halve ? (u0 + u1) * 0.5 : secant;
            const double v = value_(u);
            if (!halve && std::abs(v) < precise * std::abs(slope)) return u;
            if ((v < 0) == in0) {
                u0 = u;
                v0 = v;
            } else {
                u1 = u;
                v1 = v;
            }
        }
        return (u0 + u1) * 0.5;
    }

    void turn(std::int32_t u, bool solid) {
        if (solid) {
            begin_ = u;
        } else {
            push(u);
        }
    }

    void push(std::int32_t end) {
        out_.push(std::max(begin_, lo_), std::min(end, hi_));
        begin_ = none;
    }

    const Value& value_;
    double steepest_;
    std::int32_t lo_, hi_;
    SpanRows& out_;
    std::int32_t begin_ = none;
};

}  // namespace lamella
