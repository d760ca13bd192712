// Shortened formulas: the program of a tile, less what cannot matter there (Keeter 2020, "Massively parallel
// rendering of complex closed-form implicit surfaces", section 3).
#pragma once

#include <vector>

#include "engine/formula_interval.h"

namespace lamella {

/// A program without an owner: instructions of which the last is the result, and their constants.
struct FormulaTape {
    std::span<const FormulaInstruction> instructions;
    std::span<const double> constants;
};

/// The programs of nested tiles, the innermost last. Storage is kept for the next tiles.
class FormulaStack {
  public:
    /// Begins with the whole formula.
    explicit FormulaStack(const Formula& formula);

    /// The range of the current program over the inputs' ranges; pushes the program shortened by what those
    /// ranges decide. It gives the same numbers, bit for bit, for all inputs within them.
    FormulaRange enter(std::span<const FormulaRange> inputs);
    /// Goes back to the program before the last `enter`.
    void leave();
    /// The current program; valid until the next `enter` or `leave`.
    FormulaTape tape() const;

  private:
    struct Level {
        std::size_t begin, end;  ///< of its instructions
        std::size_t constants;   ///< number of constants that it may use
        bool own;                ///< not shared with the level below
    };
    void mark_live(std::span<const FormulaInstruction> parent);
    void shorten(const Level& parent);
    std::uint32_t emit(FormulaInstruction step, std::size_t begin);

    std::vector<FormulaInstruction> instructions_;
    std::vector<double> constants_;
    std::vector<Level> levels_;
    std::vector<FormulaRange> ranges_;
    std::vector<FormulaChoice> choices_;
    std::vector<std::uint32_t> place_;
    std::vector<char> live_;
};

}  // namespace lamella
