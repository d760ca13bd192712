// PointTree: which of many points is nearest, and which lie within a distance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A bounding-volume tree over points. Immutable and thread-safe; the same answers whatever the machine.
class PointTree {
  public:
    struct Nearest {
        std::uint32_t point = 0;    ///< its number
        double squared = infinity;  ///< of the distance, mm^2
    };

    explicit PointTree(std::vector<dvec3> points);

    bool empty() const { return points_.empty(); }
    std::span<const dvec3> points() const { return points_; }
    /// The nearest point, of equally near ones the one with the lowest number. `guess` is the number of a
    /// point: the nearer it is, the sooner the search ends. There must be points.
    Nearest nearest(dvec3 p, std::uint32_t guess = 0) const;
    /// The lesser of `limit` and the distance to the nearest point, mm.
    double distance_within(dvec3 p, double limit) const;
    /// Appends the numbers of all points at most `radius` away.
    void within(dvec3 p, double radius, std::vector<std::uint32_t>& out) const;

  private:
    struct Node {
        Box box;
        std::uint32_t first;  ///< first point of a leaf, in order_; else the second child
        std::uint32_t count;  ///< points of a leaf, 0 for an inner node
    };

    void build(std::uint32_t first, std::uint32_t last);
    void search(dvec3 p, Nearest& best) const;

    std::vector<dvec3> points_;
    std::vector<std::uint32_t> order_;
    std::vector<dvec3> sorted_;  ///< the points in that order
    std::vector<Node> nodes_;
};

}  // namespace lamella
