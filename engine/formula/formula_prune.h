// FormulaStack: formulas shortened for a tile by pruning what cannot matter there (Keeter 2020, "Massively
// parallel rendering of complex closed-form implicit surfaces", section 3).
#pragma once

#include <algorithm>
#include <vector>

#include "engine/formula/formula_interval.h"

namespace lamella {

/// View of a program: instructions, the last of which is the result, and their constants.
struct FormulaTape {
    std::span<const FormulaInstruction> instructions;
    std::span<const double> constants;
};

/// Property of the whole program that shortened ones preserve.
enum class FormulaKeeps : std::uint8_t {
    numbers,  ///< every result, bit for bit
    signs     ///< whether the number is negative, zero, positive or NaN: parts of a union that are surely
              ///< positive are pruned, however near, and so are surely negative parts of an intersection
};

/// The programs of nested tiles, the innermost last. Storage is reused for later tiles.
class FormulaStack {
  public:
    /// Starts with the whole formula.
    explicit FormulaStack(const Formula& formula, FormulaKeeps keeps = FormulaKeeps::numbers);

    /// Enters a tile: returns the range of the current program over the inputs' ranges. If these ranges
    /// decide enough choices to shorten the program by a quarter, pushes the shortened one; for all inputs in
    /// the ranges it preserves the results or their signs.
    FormulaRange enter(std::span<const FormulaRange> inputs);
    /// Restores the program before the last `enter`.
    void leave();
    /// Returns the current program; valid until it is left.
    FormulaTape tape() const;
    /// Returns a number that identifies the program: equal for levels that share one.
    std::uint64_t version() const { return levels_.back().version; }
    /// Returns the ranges of the current program's instructions over the tile just entered. Valid until the
    /// next `enter`, and only if the sign of the result is not settled in the tile.
    std::span<const FormulaRange> ranges() const { return {ranges_.data(), tape().instructions.size()}; }

  private:
    struct Level {
        std::size_t begin, end;  ///< range of its instructions
        std::size_t constants;   ///< how many constants it can use
        std::uint64_t version;
        bool own;  ///< has instructions of its own, not those of the level below
    };
    enum : char { dead, sign_matters, number_matters };
    void need(std::uint32_t i, char what) { live_[i] = std::max(live_[i], what); }
    /// Decides a choice if only its sign matters.
    void choose_by_sign(const FormulaInstruction& step, FormulaChoice& choice) const;
    /// Marks the instructions that the result needs, and counts them.
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
