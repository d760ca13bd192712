// DoubleDouble: numbers with twice the precision of a double, as unevaluated sums of two doubles.
#pragma once

namespace lamella {

/// hi + lo with |lo| at most half a unit in the last place of hi: about 32 digits (Dekker 1971). Uses + - *
/// only, so results are the same on every machine.
struct DoubleDouble {
    double hi = 0;
    double lo = 0;
};

inline DoubleDouble quick_two_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
}

inline DoubleDouble two_sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}

/// Returns the exact product of two doubles.
inline DoubleDouble two_product(double a, double b) {
    constexpr double splitter = 134217729;  // 2^27 + 1
    const double ca = splitter * a, cb = splitter * b;
    const double a_hi = ca - (ca - a), b_hi = cb - (cb - b);
    const double a_lo = a - a_hi, b_lo = b - b_hi;
    const double p = a * b;
    return {p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
    const DoubleDouble u = quick_two_sum(s.hi, s.lo + t.hi);
    return quick_two_sum(u.hi, u.lo + t.lo);
}

inline DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }
inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + -b; }

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
    const DoubleDouble p = two_product(a.hi, b.hi);
    return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

}  // namespace lamella
