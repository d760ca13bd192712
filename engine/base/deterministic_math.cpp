// The transcendental functions for one number: the shared text of transcendental-inl.h over plain doubles.
#include "engine/base/deterministic_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lamella {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

template <class V>
V Constant(double c) {
    return c;
}
double Add(double a, double b) { return a + b; }
double Sub(double a, double b) { return a - b; }
double Mul(double a, double b) { return a * b; }
double Div(double a, double b) { return a / b; }
double Neg(double a) { return -a; }
double Abs(double a) { return std::fabs(a); }
double Sqrt(double a) { return std::sqrt(a); }
double RoundDown(double a) { return std::floor(a); }
bool Lt(double a, double b) { return a < b; }
bool Eq(double a, double b) { return a == b; }
bool Or(bool a, bool b) { return a || b; }
double IfThenElse(bool c, double a, double b) { return c ? a : b; }

/// 2^k for a whole k from -1022 to 1023: adding 1.5 * 2^52 brings k + 1023 to the low bits.
double PowerOfTwo(double k) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(k + (0x1.8p52 + 1023.0)) << 52);
}
/// x = significand * 2^exponent, 1 <= significand < 2, for a normal positive x.
double Exponent(double x) {
    const std::uint64_t e = std::bit_cast<std::uint64_t>(x) >> 52;
    return std::bit_cast<double>(e | 0x4330000000000000ULL) - (0x1p52 + 1023.0);
}
double Significand(double x) {
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & 0x000FFFFFFFFFFFFFULL) |
                                 0x3FF0000000000000ULL);
}

#include "engine/base/transcendental-inl.h"

}  // namespace

SineCosine sine_cosine(double x) {
    const ReducedAngle<double> a = ReduceAngle(x);
    return {WithinReduction(x, SineOf(a)), WithinReduction(x, CosineOf(a))};
}
double sine(double x) { return Sine(x); }
double cosine(double x) { return Cosine(x); }
double tangent(double x) { return Tangent(x); }
double arcsine(double x) { return Arcsine(x); }
double arccosine(double x) { return Arccosine(x); }
double arctangent(double x) { return Arctangent(x); }
double arctangent2(double y, double x) { return Arctangent2(y, x); }
double exponential(double x) { return Exponential(x); }
double logarithm(double x) { return Logarithm(x); }

double power(double base, double exponent) {
    if (exponent == 0) return std::isnan(base) ? base : 1;
    const bool whole = std::floor(exponent) == exponent;
    if (whole && std::fabs(exponent) <= max_multiplied) {
        const double product = multiply_out(base, static_cast<int>(std::fabs(exponent)),
                                            [](double a, double b) { return a * b; });
        return exponent < 0 ? 1 / product : product;
    }
    const double magnitude = Exponential(exponent * Logarithm(std::fabs(base)));
    if (!(base < 0)) return magnitude;
    if (!whole) return quiet_nan;
    const bool odd = std::fmod(std::fabs(exponent), 2.0) == 1;
    return odd ? -magnitude : magnitude;
}

}  // namespace lamella
