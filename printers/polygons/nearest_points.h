// NearestPoints: nearest-neighbour queries on a set of points that shrinks; orders the beads of a layer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A set of points that supports nearest-point queries and removal. It is a balanced k-d tree whose nodes
/// count their remaining points; a tour of n points takes about n log n steps.
class NearestPoints {
  public:
    explicit NearestPoints(std::span<const dvec2> points);

    bool empty() const { return nodes_.empty() || nodes_[0].alive == 0; }
    /// Returns the index of a nearest remaining point. The set must not be empty.
    std::size_t nearest(dvec2 from) const;
    /// Removes a point; removing it again does nothing.
    void remove(std::size_t index);

  private:
    struct Node {
        Rect box;
        std::uint32_t begin = 0, end = 0;  // range of order_
        std::uint32_t alive = 0;
        std::uint32_t parent = 0;
        std::uint32_t child = 0;  // the first of two; 0 for a leaf
    };
    struct Best {
        double distance;
        std::size_t index;
    };
    void split(std::uint32_t node);
    void search(std::uint32_t node, dvec2 from, Best& best) const;

    std::vector<dvec2> points_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> leaf_;
    std::vector<bool> removed_;
    std::vector<Node> nodes_;
};

}  // namespace lamella
