// Enclosures, operation by operation. Endpoints are computed like points, and IEEE rounding is monotonic, so
// they enclose the rounded results.
#include "engine/formula/formula_interval.h"

#include <algorithm>
#include <limits>

namespace lamella {
namespace {

using Range = FormulaRange;

constexpr Range surely_nan{{}, true};  // surely NaN
constexpr Range anything{{-infinity, infinity}, true};
constexpr Range zero_or_one{{0, 1}, false};

bool finite(const Interval& i) { return -infinity < i.lo && i.hi < infinity; }

/// Return true only if the number is surely true, or surely false.
bool surely_true(const Range& a) { return !a.values.contains(0); }
bool surely_false(const Range& a) { return a.values.lo == 0 && a.values.hi == 0 && !a.maybe_nan; }

Range unite(const Range& a, const Range& b) {
    return {{std::min(a.values.lo, b.values.lo), std::max(a.values.hi, b.values.hi)},
            a.maybe_nan || b.maybe_nan};
}

/// Opens endpoints that came out NaN (infinity - infinity).
Range open_ended(double lo, double hi, bool maybe_nan) {
    return {{std::isnan(lo) ? -infinity : lo, std::isnan(hi) ? infinity : hi}, maybe_nan};
}

Range widened(double lo, double hi, double slack, bool maybe_nan) {
    return {{lo - slack, hi + slack}, maybe_nan};
}

/// Widens finite endpoints by a share of their magnitude and by the smallest subnormals. A lower endpoint of
/// +infinity becomes the largest number: near overflow, a result between the endpoints may still be finite.
Range widened_by_share(double lo, double hi, double share, bool maybe_nan) {
    constexpr double least = 1e-322, most = std::numeric_limits<double>::max();
    const double low = lo == -infinity ? lo : std::min(lo, most);
    return {{low - (std::isinf(low) ? 0 : std::fabs(low) * share + least),
             hi + (std::isinf(hi) ? 0 : std::fabs(hi) * share + least)},
            maybe_nan};
}

Range add(const Interval& a, const Interval& b, bool nan) {
    const bool opposite = (a.hi == infinity && b.lo == -infinity) || (a.lo == -infinity && b.hi == infinity);
    return open_ended(a.lo + b.lo, a.hi + b.hi, nan || opposite);
}

/// Returns the least and greatest of op over the four pairs of endpoints.
template <class Op>
Interval corners(const Interval& a, const Interval& b, const Op& op) {
    const double p = op(a.lo, b.lo), q = op(a.lo, b.hi), r = op(a.hi, b.lo), s = op(a.hi, b.hi);
    return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}

Range multiply(const Interval& a, const Interval& b, bool nan) {
    if (finite(a) && finite(b)) return {corners(a, b, [](double x, double y) { return x * y; }), nan};
    // 0 * infinity is NaN; the product of zero with finite numbers near infinity is 0.
    const bool undefined = (a.contains(0) && !finite(b)) || (b.contains(0) && !finite(a));
    const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
    return {corners(a, b, product), nan || undefined};
}

Range divide(const Interval& a, const Interval& b, bool nan) {
    if (b.contains(0)) {
        const bool undefined = a.contains(0) || (!finite(a) && !finite(b));
        return {{-infinity, infinity}, nan || undefined};
    }
    if (!finite(a) && !finite(b)) return anything;
    return {corners(a, b, [](double x, double y) { return x / y; }), nan};
}

Range modulo(const Interval& a, const Interval& b, bool nan) {
    const double size = std::max(std::fabs(b.lo), std::fabs(b.hi));
    nan = nan || b.contains(0) || !finite(a) || !finite(b) || (finite(a) && std::isinf(a.hi - a.lo));
    if (b.lo == b.hi && size > 0 && finite(a) && finite(b)) {
        // Within one period the remainder is monotonic.
        const double period = std::floor(a.lo / size);
        if (period == std::floor(a.hi / size) && std::fabs(period) < 0x1p52)
            return {{formula_mod(a.lo, size), formula_mod(a.hi, size)}, nan};
    }
    // An overflowing quotient leads to infinity - infinity.
    const double least = std::min(std::fabs(b.lo), std::fabs(b.hi));
    const double most = std::max(std::fabs(a.lo), std::fabs(a.hi));
    return {{0, size}, nan || std::isinf(most / least)};
}

/// Range of x^y for positive x: the extremes are at corners.
Range raise(const Range& a, const Range& b, bool nan) {
    const Interval& x = a.values;
    const Interval& y = b.values;
    if (!(x.lo > 0) || !finite(x) || !finite(y)) return anything;
    const Interval ends = corners(x, y, [](double base, double exponent) { return power(base, exponent); });
    // Finite results have a magnitude of exponent * ln(base) of at most this.
    constexpr double overflow = 800;
    const double steepest =
        std::min(overflow, std::max(std::fabs(logarithm(x.lo)), std::fabs(logarithm(x.hi))) *
                               std::max(std::fabs(y.lo), std::fabs(y.hi)));
    // Twice the stated error of power(); multiplied-out powers err by less than max_multiplied roundings.
    const Range wide = widened_by_share(ends.lo, ends.hi, 1e-15 * (20 + steepest), nan);
    // The reciprocal of an overflowed product is 0, where the exponential would be tiny.
    constexpr double tiny = 1e-290;
    return {{wide.values.lo < tiny ? 0 : wide.values.lo, std::max(wide.values.hi, tiny)}, nan};
}

Range angle(const Interval& y, const Interval& x, bool nan) {
    constexpr double slack = 4e-15;
    // The branch cut along negative x is met unless y keeps its sign; the origin may be anywhere.
    if (!finite(x) || !finite(y) || (x.lo <= 0 && y.contains(0))) return widened(-pi, pi, slack, nan);
    const Interval ends = corners(y, x, [](double v, double u) { return arctangent2(v, u); });
    return widened(ends.lo, ends.hi, slack, nan);
}

/// Range of sin(x) for shift 1/4, cos(x) for shift 0: crests lie at (n + shift) turns, troughs half a turn
/// later.
Range wave(const Interval& x, bool nan, double shift, double (*f)(double)) {
    constexpr double turn = 6.28318530717958647693, slack = 1e-14, misplaced = 1e-9;
    const double furthest = std::max(std::fabs(x.lo), std::fabs(x.hi));
    nan = nan || furthest >= 1e15;
    // Beyond this, the reduction of the angle loses digits.
    if (!(furthest < 1e5)) return {{-1 - misplaced, 1 + misplaced}, nan};
    const auto passes = [&](double offset) {
        return std::floor(x.hi / turn - offset + misplaced) > std::floor(x.lo / turn - offset - misplaced);
    };
    const double at_lo = f(x.lo), at_hi = f(x.hi);
    const double hi = passes(shift) ? 1 : std::max(at_lo, at_hi);
    const double lo = passes(shift + 0.5) ? -1 : std::min(at_lo, at_hi);
    return widened(lo, hi, slack, nan);
}

Range tangent_range(const Interval& x, bool nan) {
    constexpr double half_turn = 3.14159265358979323846, misplaced = 1e-9;
    const double furthest = std::max(std::fabs(x.lo), std::fabs(x.hi));
    if (!(furthest < 1e5)) return {{-infinity, infinity}, nan || furthest >= 1e15};
    const bool pole =
        std::floor(x.hi / half_turn + 0.5 + misplaced) > std::floor(x.lo / half_turn + 0.5 - misplaced);
    if (pole) return {{-infinity, infinity}, nan};
    // Absolute errors of sine and cosine, divided by a cosine of at least 1e-9.
    const double lo = tangent(x.lo), hi = tangent(x.hi);
    return {{lo - 1e-14 * (1 + lo * lo), hi + 1e-14 * (1 + hi * hi)}, nan};
}

/// Range of a monotonic function of numbers within [least, most], NaN outside.
Range rising(const Interval& x, bool nan, double (*f)(double), Interval domain, double slack) {
    const bool outside = x.lo < domain.lo || domain.hi < x.hi;
    const double lo = std::max(x.lo, domain.lo), hi = std::min(x.hi, domain.hi);
    if (!(lo <= hi)) return surely_nan;
    return widened(f(lo), f(hi), slack, nan || outside);
}

Range absolute(const Interval& x, bool nan) {
    if (x.lo >= 0) return {{std::fabs(x.lo), x.hi}, nan};
    if (x.hi <= 0) return {{std::fabs(x.hi), -x.lo}, nan};
    return {{0, std::max(-x.lo, x.hi)}, nan};
}

Range square_of(const Interval& x, bool nan) {
    const Interval size = absolute(x, nan).values;
    return {{size.lo * size.lo, size.hi * size.hi}, nan};
}

Range arccosine_range(const Interval& x, bool nan) {
    const bool outside = x.lo < -1 || 1 < x.hi;
    const double lo = std::max(x.lo, -1.0), hi = std::min(x.hi, 1.0);
    if (!(lo <= hi)) return surely_nan;
    return widened(arccosine(hi), arccosine(lo), 4e-15, nan || outside);
}

Range less_than(const Range& a, const Range& b, bool or_equal) {
    const bool undefined = a.maybe_nan || b.maybe_nan;
    const Interval& x = a.values;
    const Interval& y = b.values;
    const bool never = x.empty() || y.empty() || (or_equal ? y.hi < x.lo : y.hi <= x.lo);
    const bool always = !undefined && (or_equal ? x.hi <= y.lo : x.hi < y.lo);
    if (never) return {{0, 0}, false};
    return always ? Range{{1, 1}, false} : zero_or_one;
}

Range equal_to(const Range& a, const Range& b) {
    const Interval& x = a.values;
    const Interval& y = b.values;
    if (x.empty() || y.empty() || x.hi < y.lo || y.hi < x.lo) return {{0, 0}, false};
    const bool points = x.lo == x.hi && y.lo == y.hi && !a.maybe_nan && !b.maybe_nan;
    return points ? Range{{1, 1}, false} : zero_or_one;
}

/// Range of "a == a", which is 0 for NaN.
Range is_itself(const Range& a) {
    if (a.values.empty()) return {{0, 0}, false};
    return a.maybe_nan ? zero_or_one : Range{{1, 1}, false};
}

Range three_way(const Interval& x, const Interval& y, bool nan) {
    const bool less = x.lo < y.hi, greater = y.lo < x.hi;
    const bool equal = x.lo <= y.hi && y.lo <= x.hi;
    return {{less ? -1.0 : equal ? 0.0 : 1.0, greater ? 1.0 : equal ? 0.0 : -1.0}, nan};
}

}  // namespace

FormulaRange interval_apply(FormulaOp op, const FormulaRange& a) {
    const Interval& x = a.values;
    const bool nan = a.maybe_nan;
    if (op == FormulaOp::logic_not) {
        if (surely_true(a)) return {{0, 0}, false};
        return surely_false(a) ? Range{{1, 1}, false} : zero_or_one;
    }
    if (x.empty()) return surely_nan;
    switch (op) {
        case FormulaOp::neg:
            return {{-x.hi, -x.lo}, nan};
        case FormulaOp::abs:
            return absolute(x, nan);
        case FormulaOp::square:
            return square_of(x, nan);
        case FormulaOp::sqrt:
            if (x.hi < 0) return surely_nan;
            return {{std::sqrt(std::max(x.lo, 0.0)), std::sqrt(x.hi)}, nan || x.lo < 0};
        case FormulaOp::recip:
            if (x.contains(0)) return {{-infinity, infinity}, nan};
            return {{1 / x.hi, 1 / x.lo}, nan};
        case FormulaOp::floor:
            return {{std::floor(x.lo), std::floor(x.hi)}, nan};
        case FormulaOp::ceil:
            return {{std::ceil(x.lo), std::ceil(x.hi)}, nan};
        case FormulaOp::round:
            // Infinity minus its whole part is NaN, which is not >= 1/2.
            return {{formula_round(x.lo), formula_round(x.hi)}, nan};
        case FormulaOp::sin:
            return wave(x, nan, 0.25, sine);
        case FormulaOp::cos:
            return wave(x, nan, 0, cosine);
        case FormulaOp::tan:
            return tangent_range(x, nan);
        case FormulaOp::asin:
            return rising(x, nan, arcsine, {-1, 1}, 4e-15);
        case FormulaOp::acos:
            return arccosine_range(x, nan);
        case FormulaOp::atan:
            return rising(x, nan, arctangent, {-infinity, infinity}, 4e-15);
        case FormulaOp::exp: {
            const Range wide = widened_by_share(exponential(x.lo), exponential(x.hi), 2e-15, nan);
            return {{std::max(wide.values.lo, 0.0), wide.values.hi}, nan};
        }
        default: {
            if (x.hi < 0) return surely_nan;
            const double lo = logarithm(std::max(x.lo, 0.0)), hi = logarithm(x.hi);
            return widened_by_share(lo, hi, 2e-15, nan || x.lo < 0);
        }
    }
}

FormulaRange interval_apply(FormulaOp op, const FormulaRange& a, const FormulaRange& b,
                            FormulaChoice& choice) {
    const Interval& x = a.values;
    const Interval& y = b.values;
    const bool nan = a.maybe_nan || b.maybe_nan;
    choice = FormulaChoice::both;
    switch (op) {
        case FormulaOp::less:
            return less_than(a, b, false);
        case FormulaOp::less_equal:
            return less_than(a, b, true);
        case FormulaOp::equal:
            return equal_to(a, b);
        case FormulaOp::logic_and:
        case FormulaOp::logic_or: {
            const bool passes_true = op == FormulaOp::logic_or;
            if (surely_true(a)) choice = passes_true ? FormulaChoice::left : FormulaChoice::right;
            if (surely_false(a)) choice = passes_true ? FormulaChoice::right : FormulaChoice::left;
            if (choice == FormulaChoice::left) return a;
            if (choice == FormulaChoice::right) return b;
            return passes_true ? unite(a, b) : unite({{0, 0}, false}, b);
        }
        default:
            break;
    }
    if (x.empty() || y.empty()) return surely_nan;
    switch (op) {
        case FormulaOp::add:
            return add(x, y, nan);
        case FormulaOp::sub:
            return add(x, {-y.hi, -y.lo}, nan);
        case FormulaOp::mul:
            return multiply(x, y, nan);
        case FormulaOp::div:
            return divide(x, y, nan);
        case FormulaOp::mod:
            return modulo(x, y, nan);
        case FormulaOp::pow:
            return raise(a, b, nan);
        case FormulaOp::atan2:
            return angle(x, y, nan);
        case FormulaOp::min:
            // The comparison is strict where a tie would return the other argument's zero.
            if (x.hi < y.lo && !b.maybe_nan) choice = FormulaChoice::left;
            if (y.hi <= x.lo && !a.maybe_nan) choice = FormulaChoice::right;
            return {{std::min(x.lo, y.lo), std::min(x.hi, y.hi)}, nan};
        case FormulaOp::max:
            if (y.hi < x.lo && !b.maybe_nan) choice = FormulaChoice::left;
            if (x.hi <= y.lo && !a.maybe_nan) choice = FormulaChoice::right;
            return {{std::max(x.lo, y.lo), std::max(x.hi, y.hi)}, nan};
        default:
            return three_way(x, y, nan);
    }
}

FormulaRange interval_select(const FormulaRange& a, const FormulaRange& b, const FormulaRange& c,
                             FormulaChoice& choice) {
    choice = surely_true(a)    ? FormulaChoice::left
             : surely_false(a) ? FormulaChoice::right
                               : FormulaChoice::both;
    if (choice == FormulaChoice::left) return b;
    return choice == FormulaChoice::right ? c : unite(b, c);
}

namespace {

/// Handles the commonest operations on finite intervals; returns false when the general path is needed.
inline bool plain_apply(FormulaOp op, const Range& a, const Range& b, Range& out, FormulaChoice& choice) {
    const Interval& x = a.values;
    const Interval& y = b.values;
    if (!(-infinity < x.lo && x.hi < infinity && -infinity < y.lo && y.hi < infinity)) return false;
    // Empty intervals are not finite, so neither is empty here.
    out.maybe_nan = a.maybe_nan || b.maybe_nan;
    switch (op) {
        case FormulaOp::add:
            out.values = {x.lo + y.lo, x.hi + y.hi};
            return true;
        case FormulaOp::sub:
            out.values = {x.lo - y.hi, x.hi - y.lo};
            return true;
        case FormulaOp::mul:
            out.values = corners(x, y, [](double v, double w) { return v * w; });
            return true;
        case FormulaOp::min:
        case FormulaOp::max: {
            if (out.maybe_nan) return false;
            const bool least = op == FormulaOp::min;
            out.values = least ? Interval{std::min(x.lo, y.lo), std::min(x.hi, y.hi)}
                               : Interval{std::max(x.lo, y.lo), std::max(x.hi, y.hi)};
            if (least ? x.hi < y.lo : y.hi < x.lo) choice = FormulaChoice::left;
            if (least ? y.hi <= x.lo : x.hi <= y.lo) choice = FormulaChoice::right;
            return true;
        }
        default:
            return false;
    }
}

}  // namespace

bool interval_run(std::span<const FormulaInstruction> instructions, std::span<const double> constants,
                  std::span<const FormulaRange> inputs, std::span<FormulaRange> ranges,
                  std::span<FormulaChoice> choices) {
    FormulaChoice choice = FormulaChoice::both;
    bool decided = false;
    for (std::size_t i = 0; i < instructions.size(); ++i) {
        const FormulaInstruction& step = instructions[i];
        choice = FormulaChoice::both;
        if (step.op == FormulaOp::input) {
            ranges[i] = inputs[step.a];
        } else if (step.op == FormulaOp::constant) {
            const double v = constants[step.a];
            ranges[i] = std::isnan(v) ? surely_nan : Range{{v, v}, false};
        } else if (arity(step.op) == 1) {
            ranges[i] = interval_apply(step.op, ranges[step.a]);
        } else if (step.op == FormulaOp::equal && step.a == step.b) {
            ranges[i] = is_itself(ranges[step.a]);
        } else if (arity(step.op) == 2) {
            if (!plain_apply(step.op, ranges[step.a], ranges[step.b], ranges[i], choice))
                ranges[i] = interval_apply(step.op, ranges[step.a], ranges[step.b], choice);
        } else {
            ranges[i] = interval_select(ranges[step.a], ranges[step.b], ranges[step.c], choice);
        }
        if (!choices.empty()) choices[i] = choice;
        decided = decided || choice != FormulaChoice::both;
    }
    return decided;
}

FormulaRange range(const Formula& formula, std::span<const FormulaRange> inputs) {
    std::vector<FormulaRange> ranges(formula.instructions().size());
    interval_run(formula.instructions(), formula.constants(), inputs, ranges, {});
    return ranges.back();
}

}  // namespace lamella
