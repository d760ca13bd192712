// What the tests of maps between densities share: random fields, domains with holes, and differences that
// gradients are compared with.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/base/parallel.h"

namespace density_map_checks {

using Values = std::vector<double>;
using Domain = std::vector<std::uint8_t>;

inline std::size_t count_of(glm::ivec3 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
}

inline Values random_values(std::size_t count, unsigned seed, double low = 0, double high = 1) {
    std::mt19937_64 engine(seed);
    Values values(count);
    for (double& v : values) v = low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    return values;
}

/// Leaves out about one element in five.
inline Domain random_domain(std::size_t count, unsigned seed) {
    const Values values = random_values(count, seed);
    Domain domain(count);
    for (std::size_t i = 0; i < count; ++i) domain[i] = values[i] < 0.8 ? 1 : 0;
    return domain;
}

/// Compares a gradient of sum_i weight_i map(x)_i with central differences of fourth order, element by
/// element: relative to the derivative, or to a hundredth of the largest one if that is more.
template <class Map, class Backward>
void check_gradient(const Map& map, const Backward& backward, const Values& x, unsigned seed,
                    double tolerance = 1e-6, double step = 1e-4) {
    CAPTURE(seed);
    const Values weights = random_values(x.size(), seed, -1, 1);
    const auto objective = [&](std::size_t j, double change) {
        Values moved = x;
        moved[j] += change;
        const Values y = map(moved);
        double sum = 0;
        for (std::size_t i = 0; i < y.size(); ++i) sum += weights[i] * y[i];
        return sum;
    };
    map(x);
    const Values gradient = backward(weights);
    double largest = 0;
    for (const double g : gradient) largest = std::max(largest, std::fabs(g));
    REQUIRE(largest > 0);
    double worst = 0;
    std::size_t worst_at = 0;
    for (std::size_t j = 0; j < x.size(); ++j) {
        const double difference = (8 * (objective(j, step) - objective(j, -step)) -
                                   (objective(j, 2 * step) - objective(j, -2 * step))) /
                                  (12 * step);
        const double scale = std::max(std::fabs(difference), 0.01 * largest);
        const double error = std::fabs(gradient[j] - difference) / scale;
        if (error <= worst || std::isnan(worst)) continue;  // what is no number is worst
        worst = error;
        worst_at = j;
    }
    CAPTURE(worst_at);
    CHECK(worst <= tolerance);
}

/// Checks that work() gives the same bits on 1, 2 and 4 threads.
template <class Work>
void check_same_bits(const Work& work) {
    const auto with = [&](int threads) { return lamella::ThreadArena(threads).execute(work); };
    const Values one = with(1);
    REQUIRE_FALSE(one.empty());
    CHECK(with(2) == one);
    CHECK(with(4) == one);
}

}  // namespace density_map_checks
