// A sum over free elements, in the order of variable blocks.
#include "procedural/optimization/greyness.h"

#include <algorithm>

#include "procedural/optimization/variable_blocks.h"

namespace lamella {

double greyness(std::span<const ElementUse> use, std::span<const double> density) {
    const double sum = sum_over_variables<double>(use.size(), [&](std::size_t i, double& part) {
        if (use[i] == ElementUse::free) part += 4 * density[i] * (1 - density[i]);
    });
    return sum / static_cast<double>(std::ranges::count(use, ElementUse::free));
}

}  // namespace lamella
