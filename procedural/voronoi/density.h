// Density: the number of seeds per volume, evaluated at the nodes of the seed tree only.
#pragma once

#include <span>

#include "engine/base/geometry.h"

namespace lamella {

/// Seeds per cubic millimetre as a function of position. Immutable, thread-safe and deterministic.
class Density {
  public:
    virtual ~Density() = default;
    /// Returns bounds of the density over the box, seeds per mm^3.
    virtual Interval range(const Box& box) const = 0;
    /// Returns the integral of the density over the box, in seeds; positive. Called where range * volume is
    /// at most 8.
    virtual double integral(const Box& box) const = 0;
    /// Computes the integrals over many boxes, equal to those of `integral`.
    virtual void integrals(std::span<const Box> boxes, std::span<double> out) const {
        for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = integral(boxes[i]);
    }
};

/// A uniform density.
class ConstantDensity : public Density {
  public:
    explicit ConstantDensity(double seeds_per_mm3) : seeds_per_mm3_(seeds_per_mm3) {}
    Interval range(const Box&) const override { return {seeds_per_mm3_, seeds_per_mm3_}; }
    double integral(const Box& box) const override {
        const dvec3 size = box.size();
        return seeds_per_mm3_ * size.x * size.y * size.z;
    }

  private:
    double seeds_per_mm3_;
};

}  // namespace lamella
