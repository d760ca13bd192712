// The value of a formula at a point, and its range over a box.
#include "engine/formula/formula_grading.h"

#include <algorithm>

#include "engine/formula/formula_batch.h"
#include "engine/formula/formula_inputs.h"

namespace lamella {
namespace {

class FormulaGrading : public Grading {
  public:
    FormulaGrading(Formula formula, std::vector<GradingPtr> others)
        : formula_(std::move(formula)), others_(std::move(others)), read_(read_others(formula_)) {}

    double at(dvec3 p) const override { return formula_at(formula_, others_, read_, p); }

    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        constexpr std::size_t few = 32;  // of which a batch would take longer
        if (points.size() < few && read_.empty()) return Grading::numbers(points, out);
        FormulaBatch batch;
        batch.prepare({formula_.instructions(), formula_.constants()});
        std::vector<double> numbers((3 + others_.size()) * FormulaBatch::good_grid);
        std::vector<BatchInput> inputs(3 + others_.size());
        for (std::size_t i = 0; i < inputs.size(); ++i)
            inputs[i] = {numbers.data() + i * FormulaBatch::good_grid, false, true};
        for (std::size_t first = 0; first < points.size(); first += FormulaBatch::good_grid) {
            const auto part =
                points.subspan(first, std::min(points.size() - first, std::size_t{FormulaBatch::good_grid}));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                double* const to = numbers.data() + axis * FormulaBatch::good_grid;
                for (std::size_t k = 0; k < part.size(); ++k) to[k] = part[k][static_cast<int>(axis)];
            }
            for (const std::size_t i : read_)
                others_[i]->numbers(part, {numbers.data() + (3 + i) * FormulaBatch::good_grid, part.size()});
            batch.run(inputs, 1, static_cast<int>(part.size()), out.subspan(first, part.size()));
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
