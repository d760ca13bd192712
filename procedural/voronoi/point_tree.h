// PointTree: nearest-point and radius queries over a set of points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// A bounding-volume hierarchy over points. Immutable and thread-safe; answers are the same on every machine.
class PointTree {
  public:
    struct Nearest {
        std::uint32_t point = 0;    ///< index of the point
        double squared = infinity;  ///< squared distance, mm^2
    };

    explicit PointTree(std::vector<dvec3> points);

    bool empty() const { return points_.empty(); }
    std::span<const dvec3> points() const { return points_; }
    /// Returns the nearest point; among equally near ones the one with the lowest index. `guess` is the index
    /// of a point: the nearer it is, the sooner the search ends. The tree must not be empty.
    Nearest nearest(dvec3 p, std::uint32_t guess = 0) const;
    /// Returns the distance to the nearest point, at most `limit`, mm.
    double distance_within(dvec3 p, double limit) const;
    /// Appends the indices of all points at most `radius` away.
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
    std::vector<dvec3> sorted_;  ///< the points in the order of order_
    std::vector<Node> nodes_;
};

}  // namespace lamella
