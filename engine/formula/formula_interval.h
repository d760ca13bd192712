// Interval evaluation of formulas: ranges that enclose every number, and which arguments can never matter.
#pragma once

#include "engine/formula/formula.h"

namespace lamella {

/// Which argument of a min, max, and, or or select alone decides, over all values that the ranges admit.
enum class FormulaChoice : std::uint8_t {
    both,   ///< either may
    left,   ///< the first (of select: the second, its "yes")
    right,  ///< the second (of select: the third, its "no")
};

/// Encloses op(a), op(a, b) or select(a, b, c) as FormulaOp computes them: rounding is monotone, so + - * /
/// sqrt and the like need no slack; the transcendental ones get some, above their stated errors.
FormulaRange interval_apply(FormulaOp op, const FormulaRange& a);
FormulaRange interval_apply(FormulaOp op, const FormulaRange& a, const FormulaRange& b,
                            FormulaChoice& choice);
FormulaRange interval_select(const FormulaRange& a, const FormulaRange& b, const FormulaRange& c,
                             FormulaChoice& choice);

/// Ranges of all instructions and, where `choices` is given, the choices; `inputs` as for `range`. Both lists
/// have room for every instruction. Tells whether any choice is decided.
bool interval_run(std::span<const FormulaInstruction> instructions, std::span<const double> constants,
                  std::span<const FormulaRange> inputs, std::span<FormulaRange> ranges,
                  std::span<FormulaChoice> choices);

}  // namespace lamella
