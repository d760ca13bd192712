// Shortened formulas: the program of a tile, less what cannot matter there (Keeter 2020, "Massively parallel
// rendering of complex closed-form implicit surfaces", section 3).
#pragma once

#include <algorithm>
#include <vector>

#include "engine/formula/formula_interval.h"

namespace lamella {

/// A program without an owner: instructions of which the last is the result, and their constants.
struct FormulaTape {
    std::span<const FormulaInstruction> instructions;
    std::span<const double> constants;
};

/// What shortened programs have in common with the whole one.
enum class FormulaKeeps : std::uint8_t {
    numbers,  ///< every number, bit for bit
    signs     ///< whether the number is negative, zero, positive or NaN: parts of a union that are surely
              ///< positive go, however near they are, and so do surely negative parts of an intersection
};

/// The programs of nested tiles, the innermost last. Storage is kept for the next tiles.
class FormulaStack {
  public:
    /// Begins with the whole formula.
    explicit FormulaStack(const Formula& formula, FormulaKeeps keeps = FormulaKeeps::numbers);

    /// The range of the current program over the inputs' ranges; pushes the program shortened by what those
    /// ranges decide, if it gets shorter by a quarter. For all inputs within them it keeps the numbers or
    /// their signs.
    FormulaRange enter(std::span<const FormulaRange> inputs);
    /// Goes back to the program before the last `enter`.
    void leave();
    /// The current program; valid until it is left.
    FormulaTape tape() const;
    /// Tells programs apart: equal for levels that share one.
    std::uint64_t version() const { return levels_.back().version; }
    /// The ranges of the current program's instructions over the tile just entered; valid until the next
    /// `enter`, where the tile is not settled.
    std::span<const FormulaRange> ranges() const { return {ranges_.data(), tape().instructions.size()}; }

  private:
    struct Level {
        std::size_t begin, end;  ///< of its instructions
        std::size_t constants;   ///< number of constants that it may use
        std::uint64_t version;
        bool own;  ///< not shared with the level below
    };
    enum : char { dead, sign_matters, number_matters };
    void need(std::uint32_t i, char what) { live_[i] = std::max(live_[i], what); }
    /// Decides a choice of which only the sign matters.
    void choose_by_sign(const FormulaInstruction& step, FormulaChoice& choice) const;
    /// Marks what the result needs, and counts it.
    std::size_t mark_live(std::span<const FormulaInstruction> parent);
    void shorten(const Level& parent, std::size_t kept);
    FormulaInstruction fold(const FormulaInstruction& step, std::span<const FormulaInstruction> made);

    FormulaKeeps keeps_;
    std::uint64_t versions_ = 0;
    std::vector<FormulaInstruction> instructions_;
    std::vector<double> constants_;
    std::vector<Level> levels_;
    std::vector<FormulaRange> ranges_;
    std::vector<FormulaChoice> choices_;
    std::vector<std::uint32_t> place_;
    std::vector<char> live_;
};

}  // namespace lamella
