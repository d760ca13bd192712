// Transcendental functions that give the same bits on every machine and compiler: polynomials in + - * /
// only.
#pragma once

namespace lamella {

struct SineCosine {
    double sine;
    double cosine;
};

/// Sine and cosine of an angle in radians; absolute error below 2e-15 for |x| < 1e5, NaN beyond 1e15.
SineCosine sine_cosine(double x);

}  // namespace lamella
