// NodeRadius, TaperedBeams: beams whose radius varies in space, split where the variation is not linear.
#pragma once

#include <vector>

#include "engine/field/turned_grading.h"
#include "engine/solids/beam.h"

namespace lamella {

/// The radius of the foam's beams, mm. Beams that share a node sample it at the node, so they agree there.
/// Between nodes it is sampled only to find where it is not linear.
class NodeRadius {
  public:
    explicit NodeRadius(double radius) : radius_(radius), largest_(radius) {}
    /// A graded radius, nowhere above `largest`.
    NodeRadius(GradingPtr radius, double largest) : radius_(std::move(radius)), largest_(largest) {}
    double at(dvec3 p) const { return radius_->at(p); }
    bool constant() const { return radius_->constant().has_value(); }
    /// Returns bounds of the radius over the box, mm.
    Interval range(const Box& box) const { return radius_->range(box); }
    /// The radius at any point, mm.
    const Grading& grading() const { return *radius_; }
    /// Returns the radius plus `by`, mm.
    NodeRadius grown(double by) const;
    /// Returns the radius rotated or mirrored about the origin by orthogonal axes.
    NodeRadius turned(const glm::dmat3& axes) const {
        return NodeRadius(make_turned_grading(radius_.pointer(), axes), largest_);
    }
    /// Upper bound of the radius, mm.
    double largest() const { return largest_; }
    /// Upper bound of the radius in the box, mm.
    double largest_in(const Box& box) const { return std::min(radius_->range(box).hi, largest_); }

  private:
    Graded radius_;
    double largest_;
};

/// Makes beams between nodes. If the radius deviates from linear between two nodes by more than 2 %, the beam
/// is split in the middle, and its halves likewise, down to a sixteenth. Radii are sampled in batches, over
/// all beams that were added. Not thread-safe; keeps buffers for reuse.
class TaperedBeams {
  public:
    explicit TaperedBeams(NodeRadius radius) : radius_(std::move(radius)) {}
    const NodeRadius& radius() const { return radius_; }

    /// Adds a beam between two nodes, mm.
    void add(dvec3 from, dvec3 to) {
        ends_.push_back(from);
        ends_.push_back(to);
    }
    /// Appends the beams between the nodes added since the last call, in the order of adding.
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
    std::vector<dvec3> places_;  ///< points at which the radius is sampled
    std::vector<double> found_;
};

}  // namespace lamella
