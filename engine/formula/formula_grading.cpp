// The value of a formula at a point, and its range over a box.
#include "engine/formula/formula_grading.h"

#include "engine/formula/formula_inputs.h"

namespace lamella {
namespace {

class FormulaGrading : public Grading {
  public:
    FormulaGrading(Formula formula, std::vector<GradingPtr> others)
        : formula_(std::move(formula)), others_(std::move(others)), read_(read_others(formula_)) {}

    double at(dvec3 p) const override { return formula_at(formula_, others_, read_, p); }

    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        if (read_.empty()) return Grading::numbers(points, out);
        std::vector<std::vector<double>> read(others_.size());
        for (const std::size_t i : read_) {
            read[i].resize(points.size());
            others_[i]->numbers(points, read[i]);
        }
        std::vector<double> inputs(3 + others_.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            for (int axis = 0; axis < 3; ++axis) inputs[static_cast<std::size_t>(axis)] = points[k][axis];
            for (const std::size_t i : read_) inputs[3 + i] = read[i][k];
            out[k] = formula_.at(inputs);
        }
    }

    Interval range(const Box& box) const override {
        std::vector<FormulaRange> inputs;
        fill_ranges(box, others_, read_, inputs);
        const FormulaRange r = lamella::range(formula_, inputs);
        if (r.values.empty()) return {infinity, infinity};
        return {r.values.lo, r.maybe_nan ? infinity : r.values.hi};
    }

  private:
    Formula formula_;
    std::vector<GradingPtr> others_;
    std::vector<std::size_t> read_;
};

}  // namespace

GradingPtr make_formula_grading(Formula formula, std::vector<GradingPtr> others) {
    require_inputs(formula, others);
    return std::make_shared<FormulaGrading>(std::move(formula), std::move(others));
}

}  // namespace lamella
