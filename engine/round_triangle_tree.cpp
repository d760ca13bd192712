// Median splits along the longest side; leaves of a few triangles.
#include "engine/round_triangle_tree.h"

namespace lamella {
namespace {

constexpr std::uint32_t leaf_size = 4;

}  // namespace

RoundTriangleTree::RoundTriangleTree(const TriangleMesh& mesh, std::span<const double> radii)
    : mesh_(mesh), radii_(radii) {
    std::vector<dvec3> centers;
    centers.reserve(mesh.triangles.size());
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
        const auto& t = mesh.triangles[k];
        centers.push_back(mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
        if (!(std::max(radii[t[0]], std::max(radii[t[1]], radii[t[2]])) > 0)) continue;
        order_.push_back(k);
        bounds_ = unite(bounds_, lamella::bounds(round_triangle(mesh, radii, k)));
    }
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), centers);
}

void RoundTriangleTree::build(std::uint32_t first, std::uint32_t last, const std::vector<dvec3>& centers) {
    const std::size_t number = nodes_.size();
    Node node{{}, {}, first, last - first};
    Box spread;
    for (std::uint32_t k = first; k < last; ++k) {
        for (const std::uint32_t v : mesh_.triangles[order_[k]]) {
            node.box.include(mesh_.vertices[v]);
            node.radii = {std::min(node.radii.lo, radii_[v]), std::max(node.radii.hi, radii_[v])};
        }
        spread.include(centers[order_[k]]);
    }
    nodes_.push_back(node);
    if (last - first <= leaf_size) return;
    const dvec3 size = spread.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return centers[a][axis] != centers[b][axis] ? centers[a][axis] < centers[b][axis]
                                                                     : a < b;
                     });
    build(first, middle, centers);
    const auto second = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last, centers);
    nodes_[number].first = second;
    nodes_[number].count = 0;
}

/// The least of |p - x| - sign * r(x) over all points x of the mesh.
double RoundTriangleTree::nearest(dvec3 p, double sign, double best) const {
    if (nodes_.empty()) return best;
    struct Entry {
        std::uint32_t node;
        double bound;
    };
    const auto bound = [&](std::uint32_t node) {
        const Interval& radii = nodes_[node].radii;
        return lamella::distance(nodes_[node].box, p) - (sign > 0 ? radii.hi : -radii.lo);
    };
    // Halving bounds the depth: 64 levels hold any mesh that fits in memory.
    Entry stack[64];
    int top = 0;
    stack[top++] = {0, bound(0)};
    while (top > 0) {
        const Entry entry = stack[--top];
        if (entry.bound >= best) continue;
        const Node& node = nodes_[entry.node];
        if (node.count > 0) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                RoundTriangle triangle = round_triangle(mesh_, radii_, order_[k]);
                for (double& radius : triangle.radii) radius *= sign;
                Box corners;
                for (const dvec3& corner : triangle.corners) corners.include(corner);
                const double largest =
                    std::max(triangle.radii[0], std::max(triangle.radii[1], triangle.radii[2]));
                if (lamella::distance(corners, p) - largest >= best) continue;
                best = std::min(best, signed_distance(triangle, p));
            }
            continue;
        }
        const Entry left{entry.node + 1, bound(entry.node + 1)}, right{node.first, bound(node.first)};
        stack[top++] = left.bound < right.bound ? right : left;
        stack[top++] = left.bound < right.bound ? left : right;
    }
    return best;
}

}  // namespace lamella
