// Median splits along the longest side; leaves of a few triangles.
#include "engine/mesh/triangle_tree.h"

#include <numeric>

#include "engine/mesh/halving_tree.h"
#include "engine/solids/triangle_distance.h"

namespace lamella {
namespace {

double squared_distance(const Box& box, dvec3 p) {
    const dvec3 d = glm::max(glm::max(box.lo - p, p - box.hi), dvec3(0.0));
    return d.x * d.x + d.y * d.y + d.z * d.z;
}

/// Returns the position along the edge from a to b, 0 to 1, of the point closest to p.
double along_edge(dvec3 p, dvec3 a, dvec3 b) {
    const dvec3 e = b - a;
    const double length = squared_length(e);
    return length > 0 ? std::min(std::max(glm::dot(p - a, e) / length, 0.0), 1.0) : 0.0;
}

}  // namespace

SurfacePoint closest_point(dvec3 p, dvec3 a, dvec3 b, dvec3 c) {
    const dvec3 ab = b - a, bc = c - b, ca = a - c, n = glm::cross(ab, c - a);
    const double nn = glm::dot(n, n);
    // Twice the area opposite to each corner, times the length of n; signed by the direction of n.
    const dvec3 areas(glm::dot(glm::cross(bc, p - b), n), glm::dot(glm::cross(ca, p - c), n),
                      glm::dot(glm::cross(ab, p - a), n));
    SurfacePoint best;
    const double whole = areas.x + areas.y + areas.z;
    // A triangle that is a line but for its rounding has a normal, and no areas.
    if (nn > 0 && whole > 0 && areas.x >= 0 && areas.y >= 0 && areas.z >= 0) {
        best.weights = areas / whole;
        best.distance = std::abs(glm::dot(n, p - a)) / std::sqrt(nn);
        return best;
    }
    const dvec3 corners[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double t = along_edge(p, corners[i], corners[j]);
        const double d = std::sqrt(squared_length(p - (corners[i] * (1 - t) + corners[j] * t)));
        if (!(d < best.distance)) continue;
        best.distance = d;
        best.weights = dvec3(0.0);
        best.weights[i] = 1 - t;
        best.weights[j] = t;
    }
    return best;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::vector<dvec3> centers;
    centers.reserve(order_.size());
    for (const auto& t : mesh.triangles) {
        centers.push_back(mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
    }
    if (order_.empty()) return;
    build_by_halving(nodes_, order_, 0, static_cast<std::uint32_t>(order_.size()), centers,
                     [&](std::uint32_t first, std::uint32_t last) {
                         return Node{box_of(first, last), first, last - first};
                     });
}

Box TriangleTree::box_of(std::uint32_t first, std::uint32_t last) const {
    Box box;
    for (std::uint32_t k = first; k < last; ++k) {
        for (const std::uint32_t v : mesh_.triangles[order_[k]]) box.include(mesh_.vertices[v]);
    }
    return box;
}

double TriangleTree::distance(dvec3 p, double limit) const {
    double best = limit * limit;
    visit_nearest_first(
        nodes_, [&](const Node& node) { return squared_distance(node.box, p); },
        [&](double bound) { return bound < best; },
        [&](const Node& node) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                const auto& t = mesh_.triangles[order_[k]];
                const double d =
                    squared_distance(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
                best = std::min(best, d);
            }
        });
    return std::sqrt(best);
}

bool TriangleTree::any_within(dvec3 p, double distance) const {
    bool found = false;
    const double limit = distance * distance;
    visit_nearest_first(
        nodes_, [&](const Node& node) { return squared_distance(node.box, p); },
        [&](double bound) { return !found && bound < limit; },
        [&](const Node& node) {
            for (std::uint32_t k = node.first; k < node.first + node.count && !found; ++k) {
                const auto& t = mesh_.triangles[order_[k]];
                found = squared_distance(p, mesh_.vertices[t[0]], mesh_.vertices[t[1]],
                                         mesh_.vertices[t[2]]) < limit;
            }
        });
    return found;
}

SurfacePoint TriangleTree::closest(dvec3 p) const {
    // A box's distance may be rounded above that of a triangle within it: without this margin, the tree would
    // determine which of two equally close triangles is found.
    constexpr double slack = 1 - 1e-12;
    SurfacePoint best;
    const auto matters = [&](double bound) { return bound * slack <= best.distance * best.distance; };
    visit_nearest_first(
        nodes_, [&](const Node& node) { return squared_distance(node.box, p); }, matters,
        [&](const Node& node) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                const auto& t = mesh_.triangles[order_[k]];
                const dvec3 a = mesh_.vertices[t[0]], b = mesh_.vertices[t[1]], c = mesh_.vertices[t[2]];
                const Box around{glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
                if (!matters(squared_distance(around, p))) continue;
                SurfacePoint found = closest_point(p, a, b, c);
                found.triangle = order_[k];
                const bool closer = found.distance < best.distance ||
                                    (found.distance == best.distance && found.triangle < best.triangle);
                if (closer) best = found;
            }
        });
    return best;
}

int TriangleTree::winding(dvec3 p) const {
    if (nodes_.empty()) return 0;
    int winding = 0;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const std::uint32_t number = stack[--top];
        const Node& node = nodes_[number];
        const Box& box = node.box;
        if (p.y < box.lo.y || box.hi.y < p.y || p.z < box.lo.z || box.hi.z < p.z || p.x < box.lo.x) continue;
        if (node.count == 0) {
            stack[top++] = node.first;
            stack[top++] = number + 1;
            continue;
        }
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            SectionSegment s;
            if (!section_segment(mesh_, order_[k], p.z, s)) continue;
            const bool from_above = s.from.y >= p.y, to_above = s.to.y >= p.y;
            if (from_above != to_above && line_crossing(s, 0, p.y) <= p.x) winding += from_above ? 1 : -1;
        }
    }
    return winding;
}

bool section_segment(const TriangleMesh& mesh, std::uint32_t triangle, double z, SectionSegment& out) {
    const auto& t = mesh.triangles[triangle];
    const bool above[3] = {mesh.vertices[t[0]].z >= z, mesh.vertices[t[1]].z >= z,
                           mesh.vertices[t[2]].z >= z};
    if (above[0] == above[1] && above[1] == above[2]) return false;
    for (int e = 0; e < 3; ++e) {
        const int f = (e + 1) % 3;
        if (above[e] == above[f]) continue;
        // Seen from outside, the surface crosses the plane downwards on the left and upwards on the right.
        (above[e] ? out.from : out.to) =
            edge_crossing(mesh, t[static_cast<std::size_t>(e)], t[static_cast<std::size_t>(f)], z);
    }
    return true;
}

}  // namespace lamella
