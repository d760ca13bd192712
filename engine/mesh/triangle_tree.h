// TriangleTree: bounding-volume tree over triangles, for distance, closest point and winding number.
#pragma once

#include "engine/mesh/mesh.h"

namespace lamella {

/// The point of a surface that is closest to a query point.
struct SurfacePoint {
    double distance = infinity;  ///< mm
    std::uint32_t triangle = 0;
    dvec3 weights{0.0};  ///< barycentric coordinates in the triangle, 0 to 1, with sum 1
};

/// Returns the point of a triangle that is closest to p (Ericson 2005, Real-time collision detection, section
/// 5.1.5). A triangle without area counts as its longest edge. `triangle` stays 0.
SurfacePoint closest_point(dvec3 p, dvec3 a, dvec3 b, dvec3 c);

class TriangleTree {
  public:
    /// Triangles within a box.
    struct Node {
        Box box;
        std::uint32_t first;  ///< first triangle of a leaf, in order(); else the second child, the first one
                              ///< follows its parent
        std::uint32_t count;  ///< triangles of a leaf, 0 for an inner node
    };

    /// The mesh must outlive the tree.
    explicit TriangleTree(const TriangleMesh& mesh);

    /// Returns the distance from p to the nearest triangle, mm, or `limit` if it is at least that.
    double distance(dvec3 p, double limit = infinity) const;
    /// Returns true if a triangle is nearer to p than `distance`, mm.
    bool any_within(dvec3 p, double distance) const;
    /// Returns the winding number of p, from signed crossings of the ray towards -x with the same half-open
    /// rules as the mesh's sections. Meaningful for closed chains of triangles.
    int winding(dvec3 p) const;

    /// Returns the closest point of all triangles; of equally close ones, that of the lowest triangle.
    SurfacePoint closest(dvec3 p) const;

    /// Returns the nodes, the root first, children behind their parents; empty for a mesh without triangles.
    const std::vector<Node>& nodes() const { return nodes_; }
    const std::vector<std::uint32_t>& order() const { return order_; }

  private:
    Box box_of(std::uint32_t first, std::uint32_t last) const;

    const TriangleMesh& mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

/// Returns where the edge between two vertices crosses the plane at height z; the same bits whichever end is
/// given first.
inline dvec2 edge_crossing(const TriangleMesh& mesh, std::uint32_t u, std::uint32_t v, double z) {
    const dvec3 a = mesh.vertices[std::min(u, v)], b = mesh.vertices[std::max(u, v)];
    const double t = (z - a.z) / (b.z - a.z);
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
}

/// A directed piece of a section: the solid of an outward-facing triangle is on its left.
struct SectionSegment {
    dvec2 from;
    dvec2 to;
};

/// Computes the triangle's piece of the section at height z; returns false when it has none. A vertex on the
/// plane counts as above it.
bool section_segment(const TriangleMesh& mesh, std::uint32_t triangle, double z, SectionSegment& out);

/// Returns where the line at `across` crosses the segment, in the coordinates (along, across) of `along_axis`
/// 0 or 1; the same bits for a segment and its reverse. Precondition: the ends lie on both sides of the line.
inline double line_crossing(const SectionSegment& s, int along_axis, double across) {
    const int across_axis = 1 - along_axis;
    const bool upward = s.from[across_axis] <= s.to[across_axis];
    const dvec2 p = upward ? s.from : s.to, q = upward ? s.to : s.from;
    return p[along_axis] +
           (across - p[across_axis]) * ((q[along_axis] - p[along_axis]) / (q[across_axis] - p[across_axis]));
}

}  // namespace lamella
