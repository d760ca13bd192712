// Maps points one by one, and boxes by the formulas' ranges.
#include "engine/formula/mapped_grading.h"

#include "engine/formula/formula_inputs.h"

namespace lamella {
namespace {

class MappedGrading : public Grading {
  public:
    MappedGrading(GradingPtr inner, std::array<Formula, 3> place, std::vector<GradingPtr> others)
        : inner_(std::move(inner)), place_(std::move(place)), others_(std::move(others)) {
        for (std::size_t i = 0; i < 3; ++i) read_[i] = read_others(place_[i]);
    }

    double at(dvec3 p) const override {
        dvec3 q;
        for (std::size_t i = 0; i < 3; ++i)
            q[static_cast<int>(i)] = formula_at(place_[i], others_, read_[i], p);
        if (!std::isfinite(q.x + q.y + q.z)) return std::nan("");
        return inner_->at(q);
    }

    Interval range(const Box& box) const override {
        Box image;
        bool everywhere = true;
        std::vector<FormulaRange> inputs;
        for (std::size_t i = 0; i < 3; ++i) {
            fill_ranges(box, others_, read_[i], inputs);
            const FormulaRange r = lamella::range(place_[i], inputs);
            if (r.values.empty()) return {infinity, infinity};
            everywhere = everywhere && !r.maybe_nan && std::isfinite(r.values.lo + r.values.hi);
            const double most = std::numeric_limits<double>::max() / 4;  // keeps sums of sides finite
            image.lo[static_cast<int>(i)] = std::max(r.values.lo, -most);
            image.hi[static_cast<int>(i)] = std::min(r.values.hi, most);
        }
        const Interval values = inner_->range(image);
        return {values.lo, everywhere ? values.hi : infinity};
    }

  private:
    GradingPtr inner_;
    std::array<Formula, 3> place_;
    std::vector<GradingPtr> others_;
    std::array<std::vector<std::size_t>, 3> read_;
};

}  // namespace

GradingPtr make_mapped_grading(GradingPtr inner, std::array<Formula, 3> place,
                               std::vector<GradingPtr> others) {
    for (const Formula& formula : place) require_inputs(formula, others);
    return std::make_shared<MappedGrading>(std::move(inner), std::move(place), std::move(others));
}

}  // namespace lamella
