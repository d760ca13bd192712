// Densities that vary over space, with closed-form integrals, for testing trees and searches.
#pragma once

#include "procedural/voronoi/density.h"

namespace lamella {

/// One seed per mm^3 where x < plane, 512 beyond.
class JumpDensity : public Density {
  public:
    explicit JumpDensity(double plane) : plane_(plane) {}
    Interval range(const Box& box) const override {
        return {box.lo.x < plane_ ? 1.0 : 512.0, box.hi.x > plane_ ? 512.0 : 1.0};
    }
    double integral(const Box& box) const override {
        const dvec3 size = box.size();
        const double dense = std::max(box.hi.x - std::max(box.lo.x, plane_), 0.0);
        return (size.x + 511 * dense) * size.y * size.z;
    }

  private:
    double plane_;
};

/// base + slope x seeds per mm^3, positive slope; wanted where that is positive.
class RampDensity : public Density {
  public:
    RampDensity(double base, double slope) : base_(base), slope_(slope) {}
    double at(double x) const { return std::max(base_ + slope_ * x, least); }
    Interval range(const Box& box) const override { return {at(box.lo.x), at(box.hi.x)}; }
    double integral(const Box& box) const override {
        // Below the foot the density is the least one; beyond it, the area under a straight line.
        const double foot = (least - base_) / slope_;
        const double low = std::min(std::max(foot, box.lo.x), box.hi.x);
        const double under = least * (low - box.lo.x) + (at(low) + at(box.hi.x)) / 2 * (box.hi.x - low);
        return under * (box.hi.y - box.lo.y) * (box.hi.z - box.lo.z);
    }

  private:
    static constexpr double least = 0.01;
    double base_, slope_;
};

/// 1 + 3 (x^2 + y^2) seeds per mm^3.
class BowlDensity : public Density {
  public:
    Interval range(const Box& box) const override {
        const Interval x = square(box.lo.x, box.hi.x), y = square(box.lo.y, box.hi.y);
        return {1 + 3 * (x.lo + y.lo), 1 + 3 * (x.hi + y.hi)};
    }
    double integral(const Box& box) const override {
        const dvec3 a = box.lo, b = box.hi, size = box.size();
        const double x = (b.x * b.x * b.x - a.x * a.x * a.x) / 3, y = (b.y * b.y * b.y - a.y * a.y * a.y) / 3;
        return size.z * (size.x * size.y + 3 * (x * size.y + y * size.x));
    }

  private:
    static Interval square(double lo, double hi) {
        const double a = lo * lo, b = hi * hi;
        return {lo <= 0 && hi >= 0 ? 0 : std::min(a, b), std::max(a, b)};
    }
};

}  // namespace lamella
