// Transcendental functions that give the same bits on every machine and compiler: polynomials in + - * / and
// square roots only. Angles in radians. A NaN argument gives NaN.
#pragma once

#include <span>

namespace lamella {

struct SineCosine {
    double sine;
    double cosine;
};

/// Returns sine and cosine of an angle in radians; absolute error below 2e-15 for |x| < 1e5, NaN beyond 1e15.
SineCosine sine_cosine(double x);
/// Computes sine and cosine of many angles by SIMD, with the same bits as sine_cosine.
void sines_cosines(std::span<const double> angles, std::span<SineCosine> out);
double sine(double x);
double cosine(double x);
/// Relative error below 1e-14 where |x| < 1e5 and |tan x| lies in [1e-4, 1e4]; NaN beyond 1e15.
double tangent(double x);
/// Absolute error below 1e-15; NaN outside [-1, 1].
double arcsine(double x);
double arccosine(double x);
/// Relative error below 4e-16.
double arctangent(double x);
/// Returns the angle of the point (x, y) in (-pi, pi]; 0 at the origin, and a negative zero counts as zero.
/// Absolute error below 1e-15.
double arctangent2(double y, double x);
/// Relative error below 4e-16 (below 1e-323 absolute where the result is subnormal).
double exponential(double x);
/// Relative error below 4e-16; -infinity at 0, NaN below.
double logarithm(double x);
/// Returns base^exponent. Whole exponents up to 64 in magnitude are multiplied out (exact if the products
/// are); others are computed as exp(exponent ln base), with a relative error below 4e-16 (2 + |exponent ln
/// base|). NaN for a negative base and an exponent that is not whole; 1 for exponent 0 and any base but NaN.
double power(double base, double exponent);

/// The largest whole exponent that `power` multiplies out.
inline constexpr int max_multiplied = 64;

/// Returns base^n for 0 < n <= max_multiplied, with the order of multiplications of `power`.
template <class Number, class Multiply>
Number multiply_out(Number base, int n, const Multiply& multiply) {
    int bit = 1;
    while (bit * 2 <= n) bit *= 2;
    Number result = base;
    for (bit /= 2; bit > 0; bit /= 2) {
        result = multiply(result, result);
        if ((n & bit) != 0) result = multiply(result, base);
    }
    return result;
}

}  // namespace lamella
