// Gradings with closed forms, for testing the fields that they shape.
#pragma once

#include "engine/grading.h"

namespace lamella {

/// base + slope . p
class LinearGrading : public Grading {
  public:
    LinearGrading(double base, dvec3 slope) : base_(base), slope_(slope) {}
    double at(dvec3 p) const override { return base_ + glm::dot(slope_, p); }
    Interval range(const Box& box) const override {
        const dvec3 a = slope_ * box.lo, b = slope_ * box.hi, lo = glm::min(a, b), hi = glm::max(a, b);
        return {base_ + (lo.x + lo.y + lo.z), base_ + (hi.x + hi.y + hi.z)};
    }

  private:
    double base_;
    dvec3 slope_;
};

/// One number below a plane of constant x, another from there on.
class StepGrading : public Grading {
  public:
    StepGrading(double plane, double below, double above) : plane_(plane), below_(below), above_(above) {}
    double at(dvec3 p) const override { return p.x < plane_ ? below_ : above_; }
    Interval range(const Box& box) const override {
        const double first = at(box.lo), last = at(box.hi);
        return {std::min(first, last), std::max(first, last)};
    }

  private:
    double plane_, below_, above_;
};

/// Nothing is known of any place.
class UndefinedGrading : public Grading {
  public:
    double at(dvec3 /*p*/) const override { return std::numeric_limits<double>::quiet_NaN(); }
    Interval range(const Box& /*box*/) const override { return {infinity, infinity}; }
};

}  // namespace lamella
