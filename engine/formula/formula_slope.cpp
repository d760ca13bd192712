// Slope arithmetic. For two points p and q of a line, every instruction f has f(q) - f(p) within slope * (q -
// p) +- noise, for its results as computed; each rule derives this from the operands' slopes.
#include "engine/formula/formula_slope.h"

#include <cmath>

namespace lamella {
namespace {

constexpr SlopeBound unknown{};
constexpr SlopeBound flat{{0, 0}, 0};
/// Covers several times the rounding errors of the two results compared, of the slope's ends and of the
/// noise.
constexpr double rounding = 0x1p-48;
/// Covers the errors of the transcendental functions, as in the intervals.
constexpr double function_error = 2e-14;

double magnitude(const Interval& i) { return std::max(std::fabs(i.lo), std::fabs(i.hi)); }

/// Slope rules over tiles of one extent.
class Rules {
  public:
    explicit Rules(double length) : length_(length) {}

    SlopeBound plus(const SlopeBound& a, const SlopeBound& b) const {
        return rounded({{a.slope.lo + b.slope.lo, a.slope.hi + b.slope.hi}, a.noise + b.noise});
    }

    static SlopeBound negative(const SlopeBound& a) { return {{-a.slope.hi, -a.slope.lo}, a.noise}; }

    SlopeBound times(const Interval& k, const SlopeBound& a) const {
        const double p = k.lo * a.slope.lo, q = k.lo * a.slope.hi, r = k.hi * a.slope.lo,
                     s = k.hi * a.slope.hi;
        return rounded({{std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))},
                        magnitude(k) * a.noise});
    }

    /// Slope of a choice between two numbers, or of a number that changes no faster than they do.
    static SlopeBound either(const SlopeBound& a, const SlopeBound& b) {
        return {{std::min(a.slope.lo, b.slope.lo), std::max(a.slope.hi, b.slope.hi)},
                std::max(a.noise, b.noise)};
    }

    /// Adds the rounding error of an operation: a share of the result's magnitude, and an absolute error.
    static SlopeBound computed(SlopeBound a, const Interval& result, double absolute = 0) {
        a.noise += magnitude(result) * rounding + absolute + 1e-300;
        return a;
    }

  private:
    SlopeBound rounded(SlopeBound a) const {
        a.noise += magnitude(a.slope) * length_ * rounding;
        return a;
    }

    double length_;
};

/// Return the range of the cosine, or sine, over an interval of angles.
Interval cosines(const Interval& angles) { return interval_apply(FormulaOp::cos, {angles, false}).values; }
Interval sines(const Interval& angles) { return interval_apply(FormulaOp::sin, {angles, false}).values; }

/// Returns the slope of f(a) for an operation of one argument with range x and result range r.
SlopeBound one_argument(const Rules& rules, FormulaOp op, const SlopeBound& a, const Interval& x,
                        const Interval& r) {
    constexpr double furthest_angle = 1e5;
    switch (op) {
        case FormulaOp::neg:
            return Rules::negative(a);
        case FormulaOp::abs:
            if (x.lo >= 0) return a;
            return x.hi <= 0 ? Rules::negative(a) : Rules::either(a, Rules::negative(a));
        case FormulaOp::square:
            return Rules::computed(rules.times({2 * x.lo, 2 * x.hi}, a), r);
        case FormulaOp::sqrt:
            if (!(r.lo > 0)) return unknown;
            return Rules::computed(rules.times({0.5 / r.hi, 0.5 / r.lo}, a), r);
        case FormulaOp::recip: {
            if (x.contains(0)) return unknown;
            const double u = r.lo * r.lo, v = r.hi * r.hi;
            return Rules::computed(rules.times({-std::max(u, v), -std::min(u, v)}, a), r);
        }
        case FormulaOp::sin:
            if (!(magnitude(x) < furthest_angle)) return unknown;
            return Rules::computed(rules.times(cosines(x), a), r, function_error);
        case FormulaOp::cos: {
            if (!(magnitude(x) < furthest_angle)) return unknown;
            const Interval s = sines(x);
            return Rules::computed(rules.times({-s.hi, -s.lo}, a), r, function_error);
        }
        case FormulaOp::exp:
            return Rules::computed(rules.times(r, a), r, magnitude(r) * function_error);
        case FormulaOp::ln:
            if (!(x.lo > 0)) return unknown;
            return Rules::computed(rules.times({1 / x.hi, 1 / x.lo}, a), r,
                                   function_error * (1 + magnitude(r)));
        case FormulaOp::atan: {
            const double least = x.contains(0) ? 0 : std::min(std::fabs(x.lo), std::fabs(x.hi));
            const double most = magnitude(x);
            return Rules::computed(rules.times({1 / (1 + most * most), 1 / (1 + least * least)}, a), r,
                                   function_error);
        }
        default:
            return unknown;
    }
}

/// Returns the slope of an operation of two arguments with ranges x and y and slopes a and b.
SlopeBound two_arguments(const Rules& rules, FormulaOp op, const SlopeBound& a, const SlopeBound& b,
                         const Interval& x, const Interval& y, const Interval& r) {
    switch (op) {
        case FormulaOp::add:
            return Rules::computed(rules.plus(a, b), r);
        case FormulaOp::sub:
            return Rules::computed(rules.plus(a, Rules::negative(b)), r);
        case FormulaOp::mul:
            return Rules::computed(rules.plus(rules.times(x, b), rules.times(y, a)), r);
        case FormulaOp::div: {
            if (y.contains(0)) return unknown;
            const SlopeBound rest = rules.plus(a, Rules::negative(rules.times(r, b)));
            return Rules::computed(rules.times({1 / y.hi, 1 / y.lo}, rest), r);
        }
        case FormulaOp::min:
            if (x.hi < y.lo) return a;
            return y.hi < x.lo ? b : Rules::either(a, b);
        case FormulaOp::max:
            if (y.hi < x.lo) return a;
            return x.hi < y.lo ? b : Rules::either(a, b);
        default:
            return unknown;
    }
}

}  // namespace

SlopeBound FormulaSlopes::bound(const FormulaTape& tape, std::span<const FormulaRange> ranges,
                                std::uint32_t along, double length) {
    const std::size_t count = tape.instructions.size();
    if (slopes_.size() < count) slopes_.resize(count);
    const Rules rules(length);
    for (std::size_t i = 0; i < count; ++i) {
        const FormulaInstruction& step = tape.instructions[i];
        const FormulaRange& result = ranges[i];
        SlopeBound& out = slopes_[i];
        if (result.maybe_nan || !(magnitude(result.values) < infinity)) {
            out = unknown;
        } else if (result.values.lo == result.values.hi) {
            out = flat;
        } else if (step.op == FormulaOp::input) {
            // Along a line only one coordinate changes; gradings may do anything.
            out = step.a == along ? SlopeBound{{1, 1}, 0} : step.a < 3 ? flat : unknown;
        } else if (arity(step.op) == 1) {
            const SlopeBound& a = slopes_[step.a];
            out = a.flat() || !a.known()
                      ? a
                      : one_argument(rules, step.op, a, ranges[step.a].values, result.values);
        } else if (arity(step.op) == 2) {
            const SlopeBound& a = slopes_[step.a];
            const SlopeBound& b = slopes_[step.b];
            if (a.flat() && b.flat()) {
                out = flat;
            } else if (a.known() && b.known()) {
                out = two_arguments(rules, step.op, a, b, ranges[step.a].values, ranges[step.b].values,
                                    result.values);
            } else {
                out = unknown;
            }
        } else {
            const Interval& which = ranges[step.a].values;
            const bool yes = !which.contains(0);
            const bool no = which.lo == 0 && which.hi == 0 && !ranges[step.a].maybe_nan;
            out = yes ? slopes_[step.b] : no ? slopes_[step.c] : unknown;
        }
        if (!out.known()) out = unknown;
    }
    return slopes_[count - 1];
}

}  // namespace lamella
