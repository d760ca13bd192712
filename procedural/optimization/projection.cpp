// The smoothed Heaviside projection by decaying exponentials only, which cannot overflow.
//
// With sinh and cosh, tanh a + tanh c = sinh(a + c) / (cosh a cosh c), and therefore
//     P(v) = sinh(b v) / sinh(b) * cosh(b (1 - e)) / cosh(b (v - e)).
// Below, D(x) = exp(-2 b x) for x >= 0.
#include "procedural/optimization/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {
namespace {

/// Below it P differs from v by less than the rounding of the formula.
constexpr double least_sharpness = 1e-6;
constexpr std::size_t projection_block = 4096;

/// What the formulas share for one sharpness and threshold.
class SmoothStep {
  public:
    explicit SmoothStep(const Projection& p) : b_(p.sharpness), e_(p.threshold) {
        if (!(b_ >= 0 && std::isfinite(b_)))
            throw InputError("a projection of sharpness " + std::to_string(b_) + ": it must be 0 or more");
        if (!(e_ >= 0 && e_ <= 1))
            throw InputError("a projection at threshold " + std::to_string(e_) + ": it must lie in 0 to 1");
        whole_ = 1 - decay(1);
        above_ = 1 + decay(1 - e_);
        below_ = 1 + decay(e_);
    }

    double value(double v) const {
        v = std::clamp(v, 0.0, 1.0);
        if (b_ < least_sharpness) return v;
        const double t = decay(std::fabs(v - e_));
        const double step = (v < e_ ? t * above_ : above_) / (1 + t);  // exactly 1 at v = 1
        return std::min(1.0, step * ((1 - decay(v)) / whole_));
    }
    double slope(double v) const {
        if (b_ < least_sharpness) return 1;
        const double t = decay(std::fabs(v - e_)), u = 1 + t;
        return 2 * b_ * t / (u * u) * (below_ * above_ / whole_);
    }
    double threshold_slope(double v) const {
        v = std::clamp(v, 0.0, 1.0);
        if (b_ < least_sharpness) return 0;
        const double t = decay(std::fabs(v - e_)), u = 1 + t;
        return -2 * b_ * t / (u * u) * ((1 - decay(v)) * (1 - decay(1 - v)) / whole_);
    }

  private:
    double decay(double x) const { return exponential(-2 * b_ * x); }

    double b_, e_;
    double whole_ = 0, above_ = 0, below_ = 0;
};

void check_same_length(std::size_t a, std::size_t b) {
    if (a != b)
        throw InputError("fields of " + std::to_string(a) + " and " + std::to_string(b) +
                         " numbers in one projection: they must have the same length");
}

/// Calls work(i) for each i in [0, count), in parallel by blocks.
template <class Work>
void for_each_in_blocks(std::size_t count, const Work& work) {
    parallel_for((count + projection_block - 1) / projection_block, [&](std::size_t block) {
        const std::size_t end = std::min(count, (block + 1) * projection_block);
        for (std::size_t i = block * projection_block; i < end; ++i) work(i);
    });
}

/// Sums of P and of dP/de over the domain.
std::array<double, 2> projected_sums(std::span<const double> values, std::span<const std::uint8_t> domain,
                                     const SmoothStep& step) {
    std::vector<std::array<double, 2>> parts((values.size() + projection_block - 1) / projection_block);
    parallel_for(parts.size(), [&](std::size_t block) {
        std::array<double, 2> sum{};
        const std::size_t end = std::min(values.size(), (block + 1) * projection_block);
        for (std::size_t i = block * projection_block; i < end; ++i) {
            if (domain[i] == 0) continue;
            sum[0] += step.value(values[i]);
            sum[1] += step.threshold_slope(values[i]);
        }
        parts[block] = sum;
    });
    std::array<double, 2> sum{};
    for (const auto& part : parts) {
        sum[0] += part[0];
        sum[1] += part[1];
    }
    return sum;
}

}  // namespace

double projected(double v, const Projection& projection) { return SmoothStep(projection).value(v); }
double projected_slope(double v, const Projection& projection) { return SmoothStep(projection).slope(v); }
double projected_threshold_slope(double v, const Projection& projection) {
    return SmoothStep(projection).threshold_slope(v);
}

void project(std::span<const double> values, const Projection& projection, std::span<double> out) {
    check_same_length(values.size(), out.size());
    const SmoothStep step(projection);
    for_each_in_blocks(values.size(), [&](std::size_t i) { out[i] = step.value(values[i]); });
}

void project_backward(std::span<const double> values, const Projection& projection,
                      std::span<const double> gradient, std::span<double> out) {
    check_same_length(values.size(), gradient.size());
    check_same_length(values.size(), out.size());
    const SmoothStep step(projection);
    for_each_in_blocks(values.size(), [&](std::size_t i) { out[i] = gradient[i] * step.slope(values[i]); });
}

double volume_keeping_threshold(std::span<const double> values, std::span<const std::uint8_t> domain,
                                double sharpness, double mean) {
    constexpr double tolerance = 1e-13;
    constexpr int most_steps = 200;
    check_same_length(values.size(), domain.size());
    if (!(mean >= 0 && mean <= 1))
        throw InputError("a mean density of " + std::to_string(mean) + ": it must lie in 0 to 1");
    const auto outside = std::count(domain.begin(), domain.end(), std::uint8_t{0});
    const auto count = static_cast<double>(domain.size()) - static_cast<double>(outside);
    if (!(count > 0)) throw InputError("a projection cannot keep the volume of an empty domain");

    double low = 0, high = 1, threshold = 0.5, last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps; ++step) {
        const auto [sum, slope] = projected_sums(values, domain, SmoothStep({sharpness, threshold}));
        const double excess = sum / count - mean;
        if (std::fabs(excess) <= tolerance) break;
        (excess > 0 ? low : high) = threshold;  // more volume than wanted: the threshold must rise
        if (!(high - low > 0x1p-53)) break;
        const double newton = threshold - excess * count / slope;
        // A step is only trusted while the error falls quickly: sharp projections make the mean a staircase.
        const bool trusted = std::fabs(excess) < 0.5 * last && newton > low && newton < high;
        threshold = trusted ? newton : 0.5 * (low + high);
        last = trusted ? std::fabs(excess) : std::numeric_limits<double>::infinity();
    }
    return threshold;
}

}  // namespace lamella
