// Argument reduction by pi / 2 in three parts (Cody and Waite), then Taylor polynomials on [-pi / 4, pi / 4].
#include "engine/deterministic_math.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace lamella {
namespace {

// pi / 2 = part_a + part_b + part_c; part_a and part_b have trailing zero bits, so that n * part is exact for
// |n| < 2^20.
constexpr double part_a = 0x1.921fb54400000p+0;
constexpr double part_b = 0x1.0b4611a600000p-34;
constexpr double part_c = 0x1.3198a2e037073p-69;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

double sine_polynomial(double x) {
    const double s = x * x;
    double p = -1.0 / 1307674368000.0;
    p = p * s + 1.0 / 6227020800.0;
    p = p * s - 1.0 / 39916800.0;
    p = p * s + 1.0 / 362880.0;
    p = p * s - 1.0 / 5040.0;
    p = p * s + 1.0 / 120.0;
    p = p * s - 1.0 / 6.0;
    return x + x * (s * p);
}

double cosine_polynomial(double x) {
    const double s = x * x;
    double p = 1.0 / 20922789888000.0;
    p = p * s - 1.0 / 87178291200.0;
    p = p * s + 1.0 / 479001600.0;
    p = p * s - 1.0 / 3628800.0;
    p = p * s + 1.0 / 40320.0;
    p = p * s - 1.0 / 720.0;
    p = p * s + 1.0 / 24.0;
    return 1.0 - 0.5 * s + s * s * p;
}

}  // namespace

SineCosine sine_cosine(double x) {
    if (!(std::abs(x) < 1e15)) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        return {nan, nan};
    }
    const double n = std::floor(x * two_over_pi + 0.5);
    const double r = ((x - n * part_a) - n * part_b) - n * part_c;
    const double s = sine_polynomial(r), c = cosine_polynomial(r);
    switch (static_cast<std::int64_t>(n) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace lamella
