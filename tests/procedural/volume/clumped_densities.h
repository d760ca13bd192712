// Densities as a search finds them: mostly 0 or 1, something else where these meet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace lamella {

/// Returns densities of a grid, x fastest: empty or full away from a few balls' surfaces, a ramp with noise
/// near them.
inline std::vector<double> clumped_densities(const std::array<std::size_t, 3>& size, unsigned seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
    std::array<std::array<double, 4>, 4> balls{};
    const double longest = static_cast<double>(std::max({size[0], size[1], size[2]}));
    for (auto& ball : balls) {
        for (std::size_t axis = 0; axis < 3; ++axis) ball[axis] = unit() * static_cast<double>(size[axis]);
        ball[3] = (0.1 + 0.3 * unit()) * longest;
    }
    std::vector<double> densities;
    for (std::size_t i = 0; i < size[0] * size[1] * size[2]; ++i) {
        const std::array<std::size_t, 3> at{i % size[0], i / size[0] % size[1], i / size[0] / size[1]};
        double depth = -longest;
        for (const auto& ball : balls) {
            double square = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double away = static_cast<double>(at[axis]) - ball[axis];
                square += away * away;
            }
            depth = std::max(depth, ball[3] - std::sqrt(square));
        }
        densities.push_back(depth < -1.5 ? 0 : depth > 1.5 ? 1 : (depth + 1.5) / 3 * (0.8 + 0.2 * unit()));
    }
    return densities;
}

}  // namespace lamella
