// Inputs of a formula about space: a point's coordinates, then gradings.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/field/grading.h"
#include "engine/formula/formula.h"

namespace lamella {

/// Throws InputError when the formula reads an input that has no grading.
inline void require_inputs(const Formula& formula, std::span<const GradingPtr> others) {
    for (int i = 3; i < formula.input_count(); ++i) {
        const auto other = static_cast<std::size_t>(i) - 3;
        const bool given = other < others.size() && others[other] != nullptr;
        if (!given && formula.reads(i))
            throw InputError("the formula reads input " + std::to_string(i) + ", which nothing feeds");
    }
}

/// Returns the indices of the gradings that the formula reads.
inline std::vector<std::size_t> read_others(const Formula& formula) {
    std::vector<std::size_t> read;
    for (int i = 3; i < formula.input_count(); ++i) {
        if (formula.reads(i)) read.push_back(static_cast<std::size_t>(i) - 3);
    }
    return read;
}

inline FormulaRange grading_range(const Grading& grading, const Box& box) {
    const Interval values = grading.range(box);
    return {values, values.hi == infinity};
}

inline FormulaRange known_range(double lo, double hi) { return {{lo, hi}, false}; }

/// Sets the ranges of all inputs over a box; inputs that are not read stay unknown.
inline void fill_ranges(const Box& box, std::span<const GradingPtr> others, std::span<const std::size_t> read,
                        std::vector<FormulaRange>& inputs) {
    inputs.resize(3 + others.size());
    for (int i = 0; i < 3; ++i) inputs[static_cast<std::size_t>(i)] = known_range(box.lo[i], box.hi[i]);
    for (const std::size_t i : read) inputs[3 + i] = grading_range(*others[i], box);
}

/// Evaluates the formula at a point.
inline double formula_at(const Formula& formula, std::span<const GradingPtr> others,
                         std::span<const std::size_t> read, dvec3 p) {
    if (read.empty()) {
        const double inputs[3] = {p.x, p.y, p.z};
        return formula.at(inputs);
    }
    std::vector<double> inputs(3 + others.size());
    for (int i = 0; i < 3; ++i) inputs[static_cast<std::size_t>(i)] = p[i];
    for (const std::size_t i : read) inputs[3 + i] = others[i]->at(p);
    return formula.at(inputs);
}

}  // namespace lamella
