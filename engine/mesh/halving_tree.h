// Shared code of triangle trees: median splits, and traversal with the nearest node first.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

inline constexpr std::uint32_t halving_leaf_size = 4;

/// Partitions the items [first, last) of the order into a lower and an upper half along the longest side of
/// the box around their centres; returns where the upper half begins. The halves do not depend on the initial
/// order.
inline std::uint32_t halve(std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t last,
                           const std::vector<dvec3>& centers) {
    Box spread;
    for (std::uint32_t k = first; k < last; ++k) spread.include(centers[order[k]]);
    const dvec3 size = spread.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return centers[a][axis] != centers[b][axis] ? centers[a][axis] < centers[b][axis]
                                                                     : a < b;
                     });
    return middle;
}

/// Builds a tree over the items [first, last) of the order by halving. make_node(first, last) makes a leaf of
/// these items.
template <typename Node, typename MakeNode>
void build_by_halving(std::vector<Node>& nodes, std::vector<std::uint32_t>& order, std::uint32_t first,
                      std::uint32_t last, const std::vector<dvec3>& centers, const MakeNode& make_node) {
    const std::size_t number = nodes.size();
    nodes.push_back(make_node(first, last));
    if (last - first <= halving_leaf_size) return;
    const std::uint32_t middle = halve(order, first, last, centers);
    build_by_halving(nodes, order, first, middle, centers, make_node);
    const auto second = static_cast<std::uint32_t>(nodes.size());
    build_by_halving(nodes, order, middle, last, centers, make_node);
    nodes[number].first = second;
    nodes[number].count = 0;
}

/// Visits the leaves of a tree, the nearer child of each node first. Node has `first` (the first item of a
/// leaf, else the second child; the first child follows its parent) and `count` (the number of a leaf's
/// items, else 0). bound(node) is a lower bound of the distance to its items; matters(bound) returns false to
/// prune the node; leaf(node) processes a leaf.
template <typename Node, typename Bound, typename Matters, typename Leaf>
void visit_nearest_first(const std::vector<Node>& nodes, const Bound& bound, const Matters& matters,
                         const Leaf& leaf) {
    struct Entry {
        std::uint32_t node;
        double bound;
    };
    if (nodes.empty()) return;
    // Halving limits the depth: 64 levels suffice for any mesh that fits in memory.
    std::array<Entry, 64> stack;
    std::size_t top = 0;
    stack[top++] = {0, bound(nodes[0])};
    while (top > 0) {
        const Entry entry = stack[--top];
        if (!matters(entry.bound)) continue;
        const Node& node = nodes[entry.node];
        if (node.count > 0) {
            leaf(node);
            continue;
        }
        const Entry left{entry.node + 1, bound(nodes[entry.node + 1])},
            right{node.first, bound(nodes[node.first])};
        stack[top++] = left.bound < right.bound ? right : left;
        stack[top++] = left.bound < right.bound ? left : right;
    }
}

}  // namespace lamella
