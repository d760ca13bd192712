// Bisection for the multiplier of the volume constraint.
#include "procedural/optimization/oc_update.h"

#include <algorithm>
#include <cmath>

#include "procedural/optimization/variable_blocks.h"

namespace lamella {

std::vector<double> oc_update(std::span<const double> x, std::span<const double> lower,
                              std::span<const double> upper, std::span<const double> compliance_gradient,
                              std::span<const double> volume_gradient, const VolumeExcess& excess,
                              const OcSettings& settings) {
    std::vector<double> next(x.begin(), x.end()), wish(x.size());
    for_each_variable_block(x.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double ratio = volume_gradient[i] > 0 ? -compliance_gradient[i] / volume_gradient[i] : 0;
            wish[i] = x[i] * std::sqrt(std::max(0.0, ratio));
        }
    });
    double low = 0, high = 1e9;
    while ((high - low) / (low + high) > settings.tolerance) {
        const double multiplier = 0.5 * (low + high), scale = 1 / std::sqrt(multiplier);
        for_each_variable_block(x.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (!(volume_gradient[i] > 0)) continue;
                const double least = std::max(lower[i], x[i] - settings.move),
                             most = std::min(upper[i], x[i] + settings.move);
                next[i] = std::max(least, std::min(most, wish[i] * scale));
            }
        });
        (excess(next) > 0 ? low : high) = multiplier;
    }
    return next;
}

}  // namespace lamella
