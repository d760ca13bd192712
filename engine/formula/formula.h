// Formula: an immutable register program that computes one number from a few inputs.
#pragma once

#include <span>
#include <vector>

#include "engine/base/geometry.h"
#include "engine/formula/formula_op.h"

namespace lamella {

/// One step of a formula in single-assignment form. Operands are numbers of earlier instructions; an `input`
/// has its input number in `a`, a `constant` its index in the list of constants.
struct FormulaInstruction {
    FormulaOp op = FormulaOp::constant;
    std::uint32_t a = 0, b = 0, c = 0;
};

/// A formula, made by FormulaBuilder, parse_formula or read_vm. It can be evaluated at a point, over
/// intervals (`range`) or over many points at once (formula_batch.h). Inputs are numbered; in formulas about
/// space, inputs 0 to 2 are x, y, z.
class Formula {
  public:
    /// Every operand precedes its user; the last instruction is the result. FormulaBuilder ensures both.
    Formula(std::vector<FormulaInstruction> instructions, std::vector<double> constants);

    /// Returns one more than the highest input that the formula reads.
    int input_count() const { return input_count_; }
    /// Returns the number of operations, not counting leaves.
    std::size_t size() const { return steps_.size(); }
    /// Evaluates the formula at one point; `inputs` has at least input_count() entries.
    double at(std::span<const double> inputs) const;
    /// Returns true if the result depends on input `i`.
    bool reads(int i) const;

    std::span<const FormulaInstruction> instructions() const { return instructions_; }
    std::span<const double> constants() const { return constants_; }

  private:
    /// An operation on registers: inputs and constants have the first ones, results reuse the rest.
    struct Step {
        FormulaOp op;
        std::uint32_t out, a, b, c;
    };
    void assign_registers();

    std::vector<FormulaInstruction> instructions_;
    std::vector<double> constants_;
    std::vector<Step> steps_;
    std::uint32_t result_ = 0;
    std::uint32_t registers_ = 0;
    int input_count_ = 0;
};

/// Range of a number: unless it is NaN, it lies within `values` (empty: it is surely NaN).
struct FormulaRange {
    Interval values{-infinity, infinity};
    bool maybe_nan = true;
};

/// Returns a range that encloses the formula's results, exactly as `at` computes them, over all inputs in the
/// ranges.
FormulaRange range(const Formula& formula, std::span<const FormulaRange> inputs);

}  // namespace lamella
