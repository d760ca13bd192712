// Roots of functions of one variable.
#pragma once

#include <cmath>

namespace lamella {

/// Returns where a function whose values at `a` and `b` have opposite signs is 0, to a billionth of their
/// distance: the Illinois variant of the false position (Dowell and Jarratt 1971).
template <typename Function>
double root_between(const Function& function, double a, double at_a, double b, double at_b) {
    constexpr int most = 60;
    const double enough = 1e-9 * std::abs(b - a);
    int last_side = 0;
    for (int k = 0; k < most && std::abs(b - a) > enough; ++k) {
        const double t = b + (a - b) * (at_b / (at_b - at_a)), value = function(t);
        if (value == 0) return t;
        const int side = (value < 0) == (at_b < 0) ? 1 : -1;
        if (side > 0) {
            b = t;
            at_b = value;
            if (last_side == side) at_a *= 0.5;
        } else {
            a = t;
            at_a = value;
            if (last_side == side) at_b *= 0.5;
        }
        last_side = side;
    }
    return b;
}

}  // namespace lamella
