// BoxTree: the pieces of a union by their boxes, for the nearest of them and for those that meet a plane.
#pragma once

#include <vector>

#include "engine/mesh/halving_tree.h"
#include "engine/runs/interval_index.h"

namespace lamella {

/// A tree of boxes and an index over heights. Pieces are known by their number. Immutable.
class BoxTree {
  public:
    /// One box per piece, mm; one or more.
    explicit BoxTree(const std::vector<Box>& boxes) {
        std::vector<Interval> heights;
        std::vector<dvec3> centers;
        for (const Box& box : boxes) {
            heights.push_back({box.lo.z, box.hi.z});
            centers.push_back(box.center());
            order_.push_back(static_cast<std::uint32_t>(order_.size()));
        }
        by_height_ = IntervalIndex(heights, std::vector<double>(heights.size(), 0.0));
        const auto leaf = [&](std::uint32_t first, std::uint32_t last) {
            Node node{{}, first, last - first};
            for (std::uint32_t k = first; k < last; ++k) node.box = unite(node.box, boxes[order_[k]]);
            return node;
        };
        build_by_halving(nodes_, order_, 0, static_cast<std::uint32_t>(boxes.size()), centers, leaf);
    }

    /// Returns the box around all pieces, mm.
    const Box& bounds() const { return nodes_.front().box; }
    /// Returns the pieces whose boxes meet the plane at height z, mm, by number.
    std::vector<std::uint32_t> at_height(double z) const {
        std::vector<std::uint32_t> pieces;
        by_height_.query({z, z}, pieces);
        return pieces;
    }
    /// Returns the least of distance(piece) over all pieces, or `limit` if that is less. Outside its box, a
    /// piece's signed distance from p is at least that of the box.
    template <typename Distance>
    double least(dvec3 p, double limit, const Distance& distance) const {
        double best = limit;
        visit_nearest_first(
            nodes_, [&](const Node& node) { return lamella::distance(node.box, p); },
            // Inside overlapping boxes the smallest distance counts, so do not prune them.
            [&](double near) { return near < best || near == 0; },
            [&](const Node& node) {
                for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
                    best = std::min(best, distance(order_[k]));
            });
        return best;
    }

  private:
    struct Node {
        Box box;
        std::uint32_t first, count;
    };
    IntervalIndex by_height_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace lamella
