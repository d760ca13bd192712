// Median splits along the longest side; leaves of a few triangles.
#include "engine/mesh/round_triangle_tree.h"

#include "engine/mesh/halving_tree.h"

namespace lamella {

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
    if (order_.empty()) return;
    build_by_halving(nodes_, order_, 0, static_cast<std::uint32_t>(order_.size()), centers,
                     [&](std::uint32_t first, std::uint32_t last) { return leaf(first, last); });
}

RoundTriangleTree::Node RoundTriangleTree::leaf(std::uint32_t first, std::uint32_t last) const {
    Node node{{}, {}, first, last - first};
    for (std::uint32_t k = first; k < last; ++k) {
        for (const std::uint32_t v : mesh_.triangles[order_[k]]) {
            node.box.include(mesh_.vertices[v]);
            node.radii = {std::min(node.radii.lo, radii_[v]), std::max(node.radii.hi, radii_[v])};
        }
    }
    return node;
}

/// Returns the minimum of |p - x| - sign * r(x) over all points x of the mesh; at most `best`.
double RoundTriangleTree::nearest(dvec3 p, double sign, double best) const {
    const auto bound = [&](const Node& node) {
        return lamella::distance(node.box, p) - (sign > 0 ? node.radii.hi : -node.radii.lo);
    };
    visit_nearest_first(
        nodes_, bound, [&](double near) { return near < best; },
        [&](const Node& node) {
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
        });
    return best;
}

}  // namespace lamella
