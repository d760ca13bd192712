// Intersection of a round triangle and a box: its beams, then its wedge by separating axes.
#include "procedural/foam/foam_piece.h"

#include "procedural/foam/beam_box.h"

namespace lamella {
namespace {

/// Returns whether box and wedge are disjoint along an axis.
bool apart(const Wedge& wedge, const Box& box, dvec3 axis) {
    Interval corners;
    for (const dvec3& corner : wedge.corners) {
        const double at = glm::dot(corner - box.center(), axis);
        corners = {std::min(corners.lo, at), std::max(corners.hi, at)};
    }
    const double reach = glm::dot(box.size() * 0.5, glm::abs(axis));
    return corners.lo > reach || corners.hi < -reach;
}

/// Separating axis theorem: disjoint convex polyhedra are separated along a face normal of one of them or
/// along the cross product of an edge of each.
bool meets(const Wedge& wedge, const Box& box) {
    const dvec3 axes[3] = {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)};
    for (const dvec3& normal : wedge.normals) {
        if (apart(wedge, box, normal)) return false;
    }
    const auto& corners = wedge.corners;
    for (const dvec3& axis : axes) {
        if (apart(wedge, box, axis)) return false;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t next = (i + 1) % 3;
            if (apart(wedge, box, glm::cross(axis, corners[next] - corners[i])) ||
                apart(wedge, box, glm::cross(axis, corners[3 + next] - corners[3 + i])) ||
                apart(wedge, box, glm::cross(axis, corners[3 + i] - corners[i])))
                return false;
        }
    }
    return true;
}

}  // namespace

bool touches(const RoundTriangle& triangle, const Box& box) {
    const Box solid = bounds(triangle);
    if (box.empty() || intersect(solid, box).empty()) return false;
    // If the solid sticks out of the box along one axis only, it still has a point at every coordinate
    // between its ends.
    int sticks_out = 0;
    for (int axis = 0; axis < 3; ++axis) {
        sticks_out += solid.lo[axis] < box.lo[axis] || box.hi[axis] < solid.hi[axis];
    }
    if (sticks_out <= 1) return true;
    for (std::size_t i = 0; i < 3; ++i) {
        if (touches(edge_beam(triangle, i), box)) return true;
    }
    const auto between = wedge(triangle);
    return between && meets(*between, box);
}

bool touches(const FoamPiece& piece, const Box& box) {
    return std::visit([&](const auto& solid) { return touches(solid, box); }, piece);
}

}  // namespace lamella
