// Median splits and a depth-first search that visits the nearer child first.
#include "procedural/voronoi/point_tree.h"

#include <numeric>

#include "engine/mesh/halving_tree.h"

namespace lamella {
namespace {

double squared_distance(const Box& box, dvec3 p) {
    return squared_length(glm::max(glm::max(box.lo - p, p - box.hi), dvec3(0.0)));
}

}  // namespace

PointTree::PointTree(std::vector<dvec3> points) : points_(std::move(points)), order_(points_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
    sorted_.reserve(order_.size());
    for (const std::uint32_t i : order_) sorted_.push_back(points_[i]);
}

void PointTree::build(std::uint32_t first, std::uint32_t last) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({{}, first, last - first});
    for (std::uint32_t k = first; k < last; ++k) nodes_[node].box.include(points_[order_[k]]);
    if (last - first <= halving_leaf_size) return;
    const std::uint32_t middle = halve(order_, first, last, points_);
    nodes_[node].count = 0;
    build(first, middle);
    nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last);
}

void PointTree::search(dvec3 p, Nearest& best) const {
    visit_nearest_first(
        nodes_, [&](const Node& node) { return squared_distance(node.box, p); },
        [&](double bound) { return bound <= best.squared; },
        [&](const Node& node) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                const double d = squared_length(sorted_[k] - p);
                if (d < best.squared || (d == best.squared && order_[k] < best.point)) best = {order_[k], d};
            }
        });
}

PointTree::Nearest PointTree::nearest(dvec3 p, std::uint32_t guess) const {
    Nearest best{guess, squared_length(points_[guess] - p)};
    search(p, best);
    return best;
}

double PointTree::distance_within(dvec3 p, double limit) const {
    Nearest best{UINT32_MAX, limit * limit};
    search(p, best);
    return best.point == UINT32_MAX ? limit : std::sqrt(best.squared);
}

void PointTree::within(dvec3 p, double radius, std::vector<std::uint32_t>& out) const {
    const double most = radius * radius;
    visit_nearest_first(
        nodes_, [&](const Node& node) { return squared_distance(node.box, p); },
        [&](double bound) { return bound <= most; },
        [&](const Node& node) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                if (squared_length(sorted_[k] - p) <= most) out.push_back(order_[k]);
            }
        });
}

}  // namespace lamella
