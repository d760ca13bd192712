// Gradings with closed forms, for testing what they shape.
#pragma once

#include <functional>

#include "engine/field/grading.h"

namespace lamella {

/// From `lo` at x = from to `hi` at x = to, straight, constant beyond.
class Ramp : public Grading {
  public:
    Ramp(double from, double lo, double to, double hi) : from_(from), lo_(lo), to_(to), hi_(hi) {}
    double at(dvec3 p) const override { return number(p.x); }
    Interval range(const Box& box) const override {
        const double a = number(box.lo.x), b = number(box.hi.x);
        return {std::min(a, b), std::max(a, b)};
    }

  private:
    double number(double x) const {
        const double t = std::min(std::max((x - from_) / (to_ - from_), 0.0), 1.0);
        return lo_ + (hi_ - lo_) * t;
    }
    double from_, lo_, to_, hi_;
};

/// `below` where x < plane, `above` beyond.
class Step : public Grading {
  public:
    Step(double plane, double below, double above) : plane_(plane), below_(below), above_(above) {}
    double at(dvec3 p) const override { return p.x < plane_ ? below_ : above_; }
    Interval range(const Box& box) const override {
        if (box.hi.x < plane_) return {below_, below_};
        if (box.lo.x >= plane_) return {above_, above_};
        return {std::min(below_, above_), std::max(below_, above_)};
    }

  private:
    double plane_, below_, above_;
};

/// `near` at the centre, growing by `slope` per mm away from it.
class Cone : public Grading {
  public:
    Cone(dvec3 center, double near, double slope) : center_(center), near_(near), slope_(slope) {}
    double at(dvec3 p) const override { return near_ + slope_ * glm::distance(p, center_); }
    Interval range(const Box& box) const override {
        const dvec3 far = glm::max(glm::abs(box.lo - center_), glm::abs(box.hi - center_));
        return {near_ + slope_ * distance(box, center_), near_ + slope_ * glm::length(far) * (1 + 1e-12)};
    }

  private:
    dvec3 center_;
    double near_, slope_;
};

/// base + slope . p
class Linear : public Grading {
  public:
    Linear(double base, dvec3 slope) : base_(base), slope_(slope) {}
    double at(dvec3 p) const override { return base_ + glm::dot(slope_, p); }
    Interval range(const Box& box) const override {
        const dvec3 a = slope_ * box.lo, b = slope_ * box.hi, lo = glm::min(a, b), hi = glm::max(a, b);
        return {base_ + (lo.x + lo.y + lo.z), base_ + (hi.x + hi.y + hi.z)};
    }

  private:
    double base_;
    dvec3 slope_;
};

/// Nothing is known of any place.
class Undefined : public Grading {
  public:
    double at(dvec3 /*p*/) const override { return std::numeric_limits<double>::quiet_NaN(); }
    Interval range(const Box& /*box*/) const override { return {infinity, infinity}; }
};

/// A function of place whose slope never exceeds `steepest` per mm.
class SteadyFunction : public Grading {
  public:
    SteadyFunction(std::function<double(dvec3)> function, double steepest)
        : function_(std::move(function)), steepest_(steepest) {}
    double at(dvec3 p) const override { return function_(p); }
    Interval range(const Box& box) const override {
        const double middle = function_(box.center()), reach = 0.5 * glm::length(box.size()) * steepest_;
        return {middle - reach, middle + reach};
    }

  private:
    std::function<double(dvec3)> function_;
    double steepest_;
};

inline GradingPtr steady_function(std::function<double(dvec3)> f, double steepest) {
    return std::make_shared<SteadyFunction>(std::move(f), steepest);
}

}  // namespace lamella
