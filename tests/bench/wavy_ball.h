// A mesh of any number of triangles that the benchmarks share.
#pragma once

#include <cmath>

#include "engine/mesh/mesh.h"

namespace lamella::bench {

/// A ball of 50 mm radius with waves of 1 mm, made of about `triangles` triangles over latitude and
/// longitude.
inline SolidMesh wavy_ball(double triangles) {
    const int rings = static_cast<int>(std::sqrt(triangles / 4)), sectors = 2 * rings;
    SolidMesh solid;
    auto& mesh = solid.mesh;
    const auto at = [&](int r, int s) {
        const double a = pi * r / rings, b = 2 * pi * s / sectors;
        const double radius = 50 + std::sin(9 * a) * std::sin(8 * b) * std::sin(a);
        return dvec3(96, 54, 50) +
               radius * dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    };
    mesh.vertices.push_back(at(0, 0));
    for (int r = 1; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) mesh.vertices.push_back(at(r, s));
    }
    mesh.vertices.push_back(at(rings, 0));
    const auto number = [&](int r, int s) {
        if (r == 0) return 0U;
        if (r == rings) return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        return static_cast<std::uint32_t>(1 + (r - 1) * sectors + s % sectors);
    };
    for (int r = 0; r < rings; ++r) {
        for (int s = 0; s < sectors; ++s) {
            const std::uint32_t a = number(r, s), b = number(r, s + 1), c = number(r + 1, s),
                                d = number(r + 1, s + 1);
            if (r > 0) mesh.triangles.push_back({a, d, b});
            if (r + 1 < rings) mesh.triangles.push_back({a, c, d});
        }
    }
    solid.oriented_manifold = true;
    return solid;
}

}  // namespace lamella::bench
