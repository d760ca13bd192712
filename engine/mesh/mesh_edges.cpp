// Sorts the half-edges of a mesh into edges.
#include "engine/mesh/mesh_edges.h"

#include <algorithm>

#include "engine/base/disjoint_sets.h"

namespace lamella {

MeshEdges::MeshEdges(const Triangles& triangles, std::size_t vertex_count)
    : halves_(triangles.size() * 3), edge_of_(triangles.size() * 3) {
    const auto half_count = static_cast<std::uint32_t>(halves_.size());
    std::vector<std::uint32_t> start(vertex_count + 1, 0);
    const auto lower = [&](std::uint32_t h) { return std::min(from(triangles, h), to(triangles, h)); };
    for (std::uint32_t h = 0; h < half_count; ++h) ++start[lower(h) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());

    // One word per half-edge: the far end in the upper half, its own number in the lower, so that sorting
    // groups equal edges.
    std::vector<std::uint64_t> keys(half_count);
    std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
    for (std::uint32_t h = 0; h < half_count; ++h) {
        const std::uint64_t higher = std::max(from(triangles, h), to(triangles, h));
        keys[fill[lower(h)]++] = higher << 32U | h;
    }
    edges_.reserve(half_count / 2 + 1);
    for (std::uint32_t lo = 0; lo < vertex_count; ++lo) {
        std::sort(keys.begin() + start[lo], keys.begin() + start[lo + 1]);
        for (std::uint32_t i = start[lo]; i < start[lo + 1]; ++i) {
            const auto hi = static_cast<std::uint32_t>(keys[i] >> 32U);
            const auto half = static_cast<std::uint32_t>(keys[i]);
            if (i == start[lo] || edges_.back().hi != hi) edges_.push_back({lo, hi, i, i, 0});
            Edge& edge = edges_.back();
            halves_[edge.end++] = half;
            edge.forward += from(triangles, half) == lo ? 1 : 0;
            edge_of_[half] = static_cast<std::uint32_t>(edges_.size() - 1);
        }
    }
}

bool MeshEdges::is_oriented_manifold() const {
    return std::all_of(edges_.begin(), edges_.end(), [](const Edge& e) { return e.is_matched_pair(); });
}

std::size_t MeshEdges::odd_edges() const {
    return static_cast<std::size_t>(
        std::count_if(edges_.begin(), edges_.end(), [](const Edge& e) { return e.count() % 2 == 1; }));
}

std::vector<std::uint32_t> MeshEdges::bodies(std::size_t& body_count) const {
    const std::size_t triangle_count = halves_.size() / 3;
    DisjointSets connected(triangle_count);
    for (const Edge& edge : edges_) {
        const std::uint32_t first = halves_[edge.begin] / 3;
        for (const std::uint32_t half : half_edges(edge)) connected.join(first, half / 3);
    }
    // A representative is the lowest triangle of its body, so it has its number before the other triangles
    // need it.
    std::vector<std::uint32_t> number(triangle_count);
    body_count = 0;
    for (std::uint32_t t = 0; t < triangle_count; ++t) {
        const std::uint32_t r = connected.find(t);
        number[t] = r == t ? static_cast<std::uint32_t>(body_count++) : number[r];
    }
    return number;
}

}  // namespace lamella
