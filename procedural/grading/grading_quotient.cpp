// The quotient of two gradings and of their ranges.
#include "procedural/grading/grading_quotient.h"

#include <functional>

namespace lamella {
namespace {

class QuotientGrading : public Grading {
  public:
    QuotientGrading(GradingPtr numerator, GradingPtr denominator)
        : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {}
    double at(dvec3 p) const override { return numerator_->at(p) / denominator_->at(p); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*numerator_, *denominator_, points, out, std::divides<>());
    }
    Interval range(const Box& box) const override {
        const Interval n = numerator_->range(box), d = denominator_->range(box);
        if (!(d.lo > 0)) return {-infinity, infinity};
        return {std::min(n.lo / d.lo, n.lo / d.hi), std::max(n.hi / d.lo, n.hi / d.hi)};
    }

  private:
    GradingPtr numerator_, denominator_;
};

}  // namespace

GradingPtr make_quotient_grading(GradingPtr numerator, GradingPtr denominator) {
    return std::make_shared<QuotientGrading>(std::move(numerator), std::move(denominator));
}

}  // namespace lamella
