// Blends two gradings by the smoothstep of a region's value, and bounds the result.
#include "procedural/grading/region_grading.h"

#include <cmath>

#include "engine/base/error.h"

namespace lamella {
namespace {

double mean(double outside, double inside, double weight) {
    if (weight == 0) return outside;
    if (weight == 1) return inside;
    return (1 - weight) * outside + weight * inside;
}

class RegionGrading : public Grading {
  public:
    RegionGrading(GradingPtr outside, GradingPtr inside, FieldPtr region, double width)
        : outside_(std::move(outside)),
          inside_(std::move(inside)),
          region_(std::move(region)),
          width_(width) {}

    double at(dvec3 p) const override {
        constexpr double sign_alone = 1e-9;
        const double value = region_->value_within(p, width_ > 0 ? width_ / 2 : sign_alone);
        const double weight = region_weight(value, width_);
        return mean(weight < 1 ? outside_->at(p) : 0, weight > 0 ? inside_->at(p) : 0, weight);
    }

    Interval range(const Box& box) const override {
        const Interval value = region_->range(box);
        const double most = region_weight(value.lo, width_), least = region_weight(value.hi, width_);
        if (most == 0) return outside_->range(box);
        if (least == 1) return inside_->range(box);
        const Interval outside = outside_->range(box), inside = inside_->range(box);
        // The mean is linear in the weight, so its extremes are at the ends.
        const double lo = std::min(mean(outside.lo, inside.lo, least), mean(outside.lo, inside.lo, most));
        const double hi = std::max(mean(outside.hi, inside.hi, least), mean(outside.hi, inside.hi, most));
        if (std::isnan(lo) || std::isnan(hi)) return {-infinity, infinity};
        const auto rounding = [](double v) { return std::isfinite(v) ? 4e-16 * std::abs(v) : 0; };
        return {lo - rounding(lo), hi + rounding(hi)};
    }

  private:
    GradingPtr outside_, inside_;
    FieldPtr region_;
    double width_;
};

}  // namespace

double region_weight(double value, double width) {
    if (!(value < width / 2)) return 0;
    if (value <= -width / 2) return 1;
    const double t = (width / 2 - value) / width;
    return t * t * (3 - 2 * t);
}

GradingPtr make_region_grading(GradingPtr outside, GradingPtr inside, FieldPtr region, double width) {
    if (!outside || !inside || !region) throw InputError("a region was given a missing number or field");
    if (!(width >= 0) || !std::isfinite(width)) {
        throw InputError("a region blends over a width that is finite and not negative");
    }
    return std::make_shared<RegionGrading>(std::move(outside), std::move(inside), std::move(region), width);
}

}  // namespace lamella
