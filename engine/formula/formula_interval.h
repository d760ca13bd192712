// Interval evaluation of formulas: ranges that enclose every result, and arguments that can never matter.
#pragma once

#include "engine/formula/formula.h"

namespace lamella {

/// The argument that alone decides a min, max, and, or or select, for all values within the ranges.
enum class FormulaChoice : std::uint8_t {
    both,   ///< either may decide
    left,   ///< the first (of select: the second, its "yes")
    right,  ///< the second (of select: the third, its "no")
};

/// Return ranges that enclose op(a), op(a, b) or select(a, b, c) as FormulaOp computes them. Rounding is
/// monotonic, so + - * / sqrt and the like need no margin; the transcendental functions get one above their
/// stated errors.
FormulaRange interval_apply(FormulaOp op, const FormulaRange& a);
FormulaRange interval_apply(FormulaOp op, const FormulaRange& a, const FormulaRange& b,
                            FormulaChoice& choice);
FormulaRange interval_select(const FormulaRange& a, const FormulaRange& b, const FormulaRange& c,
                             FormulaChoice& choice);

/// Computes the ranges of all instructions and, if `choices` is not empty, the choices; `inputs` as for
/// `range`. Both lists have room for every instruction. Returns true if any choice is decided.
bool interval_run(std::span<const FormulaInstruction> instructions, std::span<const double> constants,
                  std::span<const FormulaRange> inputs, std::span<FormulaRange> ranges,
                  std::span<FormulaChoice> choices);

}  // namespace lamella
