// DistanceTable: the distance of an element's shape and its gradient, from samples on a lattice.
#pragma once

#include <vector>

#include "procedural/elements/element_shape.h"

namespace lamella {

/// A distance and its gradient.
struct DistanceSample {
    double distance = infinity;
    dvec3 gradient{0};
};

/// Trilinear between samples, bilinear in the plane z = 0 for a flat table. Its gradient is exactly that of
/// the interpolated distance. Immutable.
class DistanceTable {
  public:
    /// Samples the shape's bounds and `margin` mm around them, about `samples` along the longest side.
    DistanceTable(const ElementShape& shape, double margin, int samples, bool is_flat);

    /// Returns the distance at a point; infinity outside the table.
    DistanceSample at(dvec3 p) const;
    /// Returns the radius of a ball about the origin that holds the shape, mm.
    double reach() const { return reach_; }
    /// Returns the volume of the shape, mm^3, or its area if the table is flat, mm^2, from the samples.
    double content() const { return content_; }
    /// Returns the diameter of the largest ball inside the shape, mm, from the samples.
    double thickness() const { return thickness_; }

  private:
    std::size_t number(glm::ivec3 at) const {
        return static_cast<std::size_t>(at.x) +
               static_cast<std::size_t>(size_.x) *
                   (static_cast<std::size_t>(at.y) +
                    static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(at.z));
    }

    bool is_flat_;
    double step_;
    dvec3 corner_;
    glm::ivec3 size_;  ///< samples along each side
    std::vector<double> samples_;
    double reach_ = 0, content_ = 0, thickness_ = 0;
};

}  // namespace lamella
