// RoundTriangleTree: bounding-volume tree over triangles with a radius at each vertex; finds the nearest
// ball.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/mesh.h"
#include "engine/solids/round_triangle.h"

namespace lamella {

/// The least distance to the balls around the points of a mesh, with radii interpolated between the vertices.
class RoundTriangleTree {
  public:
    /// One radius per vertex, mm, >= 0; triangles whose radii are all 0 are skipped. The mesh and the radii
    /// must outlive the tree.
    RoundTriangleTree(const TriangleMesh& mesh, std::span<const double> radii);

    /// Returns the signed distance to the union of the round triangles, mm: exact outside; inside, its
    /// magnitude never exceeds the distance. Infinite if there are no triangles.
    double distance(dvec3 p) const { return nearest(p, 1, infinity); }
    /// Returns the least sum of the distance from p to a point of the mesh and the radius there, mm; at most
    /// `limit`.
    double min_detour(dvec3 p, double limit) const { return nearest(p, -1, limit); }
    const Box& bounds() const { return bounds_; }

  private:
    struct Node {
        Box box;              ///< of the corners
        Interval radii;       ///< at the corners
        std::uint32_t first;  ///< first triangle (leaf) or second child (the first one follows its parent)
        std::uint32_t count;  ///< triangles of a leaf, 0 for an inner node
    };

    Node leaf(std::uint32_t first, std::uint32_t last) const;
    double nearest(dvec3 p, double sign, double best) const;

    const TriangleMesh& mesh_;
    std::span<const double> radii_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    Box bounds_;
};

/// Returns triangle number `triangle` of a mesh with a radius at each vertex.
inline RoundTriangle round_triangle(const TriangleMesh& mesh, std::span<const double> radii,
                                    std::uint32_t triangle) {
    const auto& t = mesh.triangles[triangle];
    return {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]},
            {radii[t[0]], radii[t[1]], radii[t[2]]}};
}

}  // namespace lamella
