// A k-d tree with counts of the remaining points.
#include "printers/polygons/nearest_points.h"

#include <algorithm>
#include <numeric>

namespace lamella {
namespace {

constexpr std::uint32_t leaf_size = 8;

double squared_distance(const Rect& box, dvec2 p) {
    return squared_length(glm::max(glm::max(box.lo - p, p - box.hi), dvec2(0.0)));
}

}  // namespace

NearestPoints::NearestPoints(std::span<const dvec2> points)
    : points_(points.begin(), points.end()),
      order_(points.size()),
      leaf_(points.size()),
      removed_(points.size(), false) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (points.empty()) return;
    Node root;
    root.end = static_cast<std::uint32_t>(points.size());
    nodes_.push_back(root);
    for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
}

void NearestPoints::split(std::uint32_t index) {
    Node node = nodes_[index];
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        node.box = unite(node.box, Rect{points_[order_[i]], points_[order_[i]]});
    }
    node.alive = node.end - node.begin;
    if (node.alive <= leaf_size) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) leaf_[order_[i]] = index;
    } else {
        const dvec2 size = node.box.size();
        const int axis = size.x < size.y ? 1 : 0;
        const std::uint32_t middle = node.begin + node.alive / 2;
        const auto at = [&](std::uint32_t i) { return order_.begin() + i; };
        // Ties are broken by index, so that the tree is the same with every standard library.
        std::nth_element(at(node.begin), at(middle), at(node.end), [&](std::uint32_t a, std::uint32_t b) {
            return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
        });
        node.child = static_cast<std::uint32_t>(nodes_.size());
        Node half;
        half.parent = index;
        half.begin = node.begin;
        half.end = middle;
        nodes_.push_back(half);
        half.begin = middle;
        half.end = node.end;
        nodes_.push_back(half);
    }
    nodes_[index] = node;
}

void NearestPoints::search(std::uint32_t index, dvec2 from, Best& best) const {
    const Node& node = nodes_[index];
    if (node.child == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const std::size_t point = order_[i];
            if (removed_[point]) continue;
            const double distance = squared_length(points_[point] - from);
            if (distance < best.distance || (distance == best.distance && point < best.index)) {
                best = {distance, point};
            }
        }
        return;
    }
    const double first = squared_distance(nodes_[node.child].box, from);
    const double second = squared_distance(nodes_[node.child + 1].box, from);
    const std::uint32_t far = first <= second ? 1 : 0;
    for (const std::uint32_t side : {1 - far, far}) {
        const bool closer = (side == 0 ? first : second) < best.distance;
        if (closer && nodes_[node.child + side].alive > 0) search(node.child + side, from, best);
    }
}

std::size_t NearestPoints::nearest(dvec2 from) const {
    Best best{infinity, points_.size()};
    search(0, from, best);
    return best.index;
}

void NearestPoints::remove(std::size_t index) {
    if (removed_[index]) return;
    removed_[index] = true;
    for (std::uint32_t node = leaf_[index];; node = nodes_[node].parent) {
        --nodes_[node].alive;
        if (node == 0) return;
    }
}

}  // namespace lamella
