// MeshEdges: the edges of a mesh and the triangles that meet there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/mesh.h"

namespace lamella {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The edges of a list of triangles. Half-edge 3t + i runs from corner i of triangle t to its next corner.
/// Built in O(n log valence) by sorting each vertex's edges; the order depends on the triangles alone.
class MeshEdges {
  public:
    struct Edge {
        std::uint32_t lo, hi;      ///< its ends, lo < hi
        std::uint32_t begin, end;  ///< range of its half-edges in half_edges()
        std::uint32_t forward;     ///< how many of them run from lo to hi

        std::uint32_t count() const { return end - begin; }
        /// Returns occurrences of (lo, hi) minus those of (hi, lo): zero everywhere means the chain is
        /// closed.
        std::int64_t net() const { return 2 * static_cast<std::int64_t>(forward) - count(); }
        bool is_matched_pair() const { return count() == 2 && forward == 1; }
    };

    /// No triangle may repeat a vertex.
    MeshEdges(const Triangles& triangles, std::size_t vertex_count);

    const std::vector<Edge>& edges() const { return edges_; }
    std::span<const std::uint32_t> half_edges(const Edge& e) const {
        return std::span(halves_).subspan(e.begin, e.count());
    }
    std::uint32_t edge_of(std::size_t half_edge) const { return edge_of_[half_edge]; }

    bool is_oriented_manifold()
        const;                      ///< every edge has two triangles that run along it in opposite directions
    std::size_t odd_edges() const;  ///< edges with an odd number of triangles: no reorientation closes them

    /// Returns a number for each triangle: equal for triangles connected through shared edges; 0, 1, ... by
    /// first triangle.
    std::vector<std::uint32_t> bodies(std::size_t& body_count) const;

  private:
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> halves_;
    std::vector<std::uint32_t> edge_of_;
};

/// Returns the half-edge's start vertex, and its end vertex.
inline std::uint32_t from(const Triangles& triangles, std::uint32_t half) {
    return triangles[half / 3][half % 3];
}
inline std::uint32_t to(const Triangles& triangles, std::uint32_t half) {
    return triangles[half / 3][(half % 3 + 1) % 3];
}

}  // namespace lamella
