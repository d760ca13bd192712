// Beams whose radius varies in space, split where it bends.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "engine/solids/beam.h"

namespace lamella {

/// The radius of the foam's beams, mm: asked at nodes only, so all beams of a node agree, and between them
/// where it bends.
class NodeRadius {
  public:
    explicit NodeRadius(double radius) : radius_(radius), largest_(radius) {}
    /// A graded radius, nowhere above `largest`.
    NodeRadius(GradingPtr radius, double largest) : radius_(std::move(radius)), largest_(largest) {}
    double at(dvec3 p) const { return radius_->at(p); }
    bool constant() const { return radius_->constant().has_value(); }
    /// Encloses the radii of the nodes in the box.
    Interval range(const Box& box) const { return radius_->range(box); }
    /// The radius at any point, mm.
    const Grading& grading() const { return *radius_; }
    /// Every radius larger by a length, mm.
    NodeRadius grown(double by) const;
    /// No node has a larger one.
    double largest() const { return largest_; }
    /// No node in the box has a larger one.
    double largest_in(const Box& box) const { return std::min(radius_->range(box).hi, largest_); }

  private:
    Graded radius_;
    double largest_;
};

/// Makes beams between nodes. Where the radius between two of them leaves the straight line by more than 2 %,
/// the beam is split in the middle, and its halves likewise, down to a sixteenth. Radii are asked for many
/// places at a time, of all beams that were added. Not thread-safe; keeps buffers for reuse.
class TaperedBeams {
  public:
    explicit TaperedBeams(NodeRadius radius) : radius_(std::move(radius)) {}
    const NodeRadius& radius() const { return radius_; }

    /// Adds a beam between two nodes, mm.
    void add(dvec3 from, dvec3 to) {
        ends_.push_back(from);
        ends_.push_back(to);
    }
    /// Appends the beams between the nodes that were added since the last time, in that order.
    void append(std::vector<Beam>& beams);

  private:
    struct Part {
        Beam beam;
        bool is_straight;
    };
    void find_radii();
    bool split();

    NodeRadius radius_;
    std::vector<dvec3> ends_;
    std::vector<Part> parts_, halves_;
    std::vector<dvec3> places_;  ///< where the radius is asked for
    std::vector<double> found_;
};

}  // namespace lamella
