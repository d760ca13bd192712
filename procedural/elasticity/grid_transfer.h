// Restriction and interpolation between a grid of nodes and the one of twice the element size.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/base/parallel.h"
#include "procedural/elasticity/node_grid.h"

namespace lamella {

/// Sums fine nodes into coarse ones: the transpose of interpolate().
template <std::size_t Dim>
void restrict_to(const NodeGrid<Dim>& fine, const NodalVector<Dim, float>& from, const NodeGrid<Dim>& coarse,
                 NodalVector<Dim, float>& to) {
    const glm::ivec3 n = coarse.nodes(), most = fine.nodes();
    const auto length = static_cast<std::size_t>(most.x);
    parallel_for(n.y * n.z, [&](int row) {
        const int y = row % n.y, z = row / n.y;
        // One more on either side than the fine row has: coarse nodes reach beyond it.
        std::vector<float> sum(length + 4);
        for (std::size_t d = 0; d < Dim; ++d) {
            std::fill(sum.begin(), sum.end(), 0.0F);
            for (int dz = Dim == 2 ? 0 : -1; dz <= (Dim == 2 ? 0 : 1); ++dz) {
                for (int dy = -1; dy <= 1; ++dy) {
                    const int j = 2 * y + dy, k = 2 * z + dz;
                    if (j < 0 || k < 0 || j >= most.y || k >= most.z) continue;
                    const float w = (dy == 0 ? 1.0F : 0.5F) * (dz == 0 ? 1.0F : 0.5F);
                    const float* values = from.along[d].data() + fine.number(0, j, k);
                    for (std::size_t i = 0; i < length; ++i) sum[i + 1] += w * values[i];
                }
            }
            float* out = to.along[d].data() + coarse.number(0, y, z);
            for (std::size_t i = 0; i < static_cast<std::size_t>(n.x); ++i)
                out[i] = sum[2 * i + 1] + 0.5F * (sum[2 * i] + sum[2 * i + 2]);
        }
    });
}

/// Adds the interpolation of coarse nodes to the fine nodes that move.
template <std::size_t Dim>
void interpolate(const NodeGrid<Dim>& coarse, const NodalVector<Dim, float>& from, const NodeGrid<Dim>& fine,
                 const NodalVector<Dim, float>& inverse, NodalVector<Dim, float>& to) {
    const glm::ivec3 n = fine.nodes();
    const auto length = static_cast<std::size_t>(coarse.nodes().x);
    parallel_for(n.y * n.z, [&](int row) {
        const int y = row % n.y, z = row / n.y, odd_y = y % 2, odd_z = z % 2;
        const float w = (odd_y != 0 ? 0.5F : 1.0F) * (odd_z != 0 ? 0.5F : 1.0F);
        std::vector<float> sum(length + 1);
        for (std::size_t d = 0; d < Dim; ++d) {
            std::fill(sum.begin(), sum.end(), 0.0F);
            for (int dz = 0; dz <= odd_z; ++dz) {
                for (int dy = 0; dy <= odd_y; ++dy) {
                    const float* values = from.along[d].data() + coarse.number(0, y / 2 + dy, z / 2 + dz);
                    for (std::size_t i = 0; i < length; ++i) sum[i] += w * values[i];
                }
            }
            const std::size_t first = fine.number(0, y, z);
            const float* moves = inverse.along[d].data() + first;
            float* out = to.along[d].data() + first;
            for (std::size_t i = 0; i < static_cast<std::size_t>(n.x); ++i) {
                const float value = i % 2 == 0 ? sum[i / 2] : 0.5F * (sum[i / 2] + sum[i / 2 + 1]);
                if (moves[i] > 0) out[i] += value;
            }
        }
    });
}

}  // namespace lamella
