// Gradings with known slopes for tests.
#pragma once

#include <functional>

#include "engine/grading.h"

namespace lamella::gradings {

/// A function of place whose slope never exceeds `steepest` per mm.
class Function : public Grading {
  public:
    Function(std::function<double(dvec3)> function, double steepest)
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

inline GradingPtr function(std::function<double(dvec3)> f, double steepest) {
    return std::make_shared<Function>(std::move(f), steepest);
}

}  // namespace lamella::gradings
