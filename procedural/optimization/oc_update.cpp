// Bisection for the multiplier of the volume constraint.
#include "procedural/optimization/oc_update.h"

#include <algorithm>
#include <cmath>

#include "procedural/optimization/variable_blocks.h"

namespace lamella {

std::vector<double> oc_update(const OcProblem& problem, const OcSettings& settings) {
    const std::size_t count = problem.x.size();
    std::vector<double> next(problem.x.begin(), problem.x.end()), wish(count), least(count), most(count);
    for_each_variable_block(count, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double ratio = problem.volume_gradient[i] > 0
                                     ? -problem.compliance_gradient[i] / problem.volume_gradient[i]
                                     : 0;
            wish[i] = problem.x[i] * std::sqrt(std::max(0.0, ratio));
            least[i] = std::max(problem.lower[i], problem.x[i] - settings.move);
            most[i] = std::min(problem.upper[i], problem.x[i] + settings.move);
        }
    });
    double low = 0, high = 1e9;
    while ((high - low) / (low + high) > settings.tolerance) {
        const double multiplier = 0.5 * (low + high), scale = 1 / std::sqrt(multiplier);
        const double growth = sum_over_variables<double>(count, [&](std::size_t i, double& sum) {
            if (!(problem.volume_gradient[i] > 0)) return;
            next[i] = std::max(least[i], std::min(most[i], wish[i] * scale));
            sum += problem.volume_gradient[i] * (next[i] - problem.x[i]);
        });
        (problem.excess + growth > 0 ? low : high) = multiplier;
    }
    return next;
}

}  // namespace lamella
