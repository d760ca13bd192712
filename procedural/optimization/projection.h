// The smoothed Heaviside projection, which drives filtered densities to 0 and 1.
#pragma once

#include <cstdint>
#include <span>

namespace lamella {

/// Sharpness b >= 0 (0: the values stay as they are) and threshold e in [0, 1], near which densities part.
struct Projection {
    double sharpness = 1;
    double threshold = 0.5;
};

/// Returns P(v) for v in [0, 1] (values beyond are taken as the nearest limit): Wang, Lazarov, Sigmund 2011,
/// "On projection methods, convergence and robust formulations in topology optimization",
///
///     P(v) = (tanh(b e) + tanh(b (v - e))) / (tanh(b e) + tanh(b (1 - e))),
///
/// in a form without differences of hyperbolic tangents, so that small densities keep their digits. P(0) = 0
/// and P(1) = 1 exactly. Throws InputError for a sharpness that is negative or not finite and for a threshold
/// outside [0, 1]; the functions below do so as well.
double projected(double v, const Projection& projection);
/// Returns dP/dv.
double projected_slope(double v, const Projection& projection);
/// Returns dP/de, which is not positive.
double projected_threshold_slope(double v, const Projection& projection);

/// Projects a field. `out` may be the same memory as `values`. The field versions throw InputError if the
/// spans differ in length.
void project(std::span<const double> values, const Projection& projection, std::span<double> out);
/// Computes the gradient with respect to the values from that with respect to the projected ones, at a fixed
/// threshold: out_i = gradient_i dP/dv(values_i). `out` may be the same memory as `gradient`.
void project_backward(std::span<const double> values, const Projection& projection,
                      std::span<const double> gradient, std::span<double> out);

/// Returns the threshold at which the mean of the projected values over the domain (mask, 0: outside) is
/// `mean`, to 1e-13 (Li and Khandelwal 2015, "Volume preserving projection filters and continuation methods
/// in topology optimization"; Newton's method, with bisection where a step leaves the bracket). The mean
/// falls as the threshold rises; if no threshold in [0, 1] gives the mean, returns the end that comes
/// nearest. The sums are bit-equal for any number of threads. Throws InputError if the domain is empty or the
/// mean lies outside [0, 1].
double volume_keeping_threshold(std::span<const double> values, std::span<const std::uint8_t> domain,
                                double sharpness, double mean);

}  // namespace lamella
