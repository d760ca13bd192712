// Formulas over many points at once, by SIMD: the same bits at every point as Formula::at.
#pragma once

#include <vector>

#include "engine/formula/formula_prune.h"

namespace lamella {

/// Numbers on a grid of lines x points. What does not vary along one of them is given once for it: an input
/// that varies neither way is one number.
struct BatchInput {
    const double* numbers =
        nullptr;  ///< numbers[line * points + point], without the factors that do not vary
    bool by_line = false;
    bool by_point = false;
};

/// One step over a grid, for the kernel: numbers stand in groups of `batch_group` along a line.
struct BatchStep {
    struct Operand {
        const double* at;
        std::size_t line_stride;  ///< 0 where all lines are alike
        std::size_t point_mask;   ///< 0 where all points of a line are alike, else all ones
    };
    FormulaOp op;
    bool by_line, by_point;
    bool contiguous;  ///< the operands are laid out as the result is, or are single numbers
    double* out;
    std::size_t out_stride;
    Operand a, b, c;
};

/// The numbers of a group fill whole vectors of every target.
inline constexpr std::size_t batch_group = 8;

/// Evaluates programs over grids. Parts of the program that depend on the point within the line alone, or on
/// the line alone, are worked out once for it. Keeps its registers for the next grid; not thread-safe.
class FormulaBatch {
  public:
    /// Programs are fastest on grids of about this many numbers: then the registers fit the first-level
    /// cache.
    static constexpr int good_grid = 512;

    /// Takes the program to evaluate; it must outlive the calls of `run`.
    void prepare(const FormulaTape& tape);
    /// The numbers of the prepared program: out[line * points + point]. inputs[i] is input i; those that the
    /// program does not read may be left out.
    void run(std::span<const BatchInput> inputs, int lines, int points, std::span<double> out);

  private:
    enum : std::uint8_t { varies_by_point = 1, varies_by_line = 2 };
    struct Place {
        BatchStep::Operand operand;
        std::uint8_t varies;
    };
    /// An input that the program reads.
    struct Load {
        std::uint32_t input;
        double* to;
    };
    /// Registers and steps for grids of one layout; lists of points, whatever their length, share one.
    struct Layout {
        std::size_t lines = 0, padded = 0;  ///< that there is room for; none before the first run
        std::vector<std::uint8_t> varies;   ///< of each input
        std::vector<Place> places;
        std::vector<Load> loads;
        std::vector<BatchStep> steps;
        std::vector<double> registers;

        bool fits(std::span<const BatchInput> inputs, std::size_t line_count, std::size_t width) const;
        Place place(std::uint32_t slot, int varies_how) const;
        void load(const BatchInput& input, double* to, std::size_t points, std::size_t width) const;
    };
    void lay_out(std::span<const BatchInput> inputs, std::size_t lines, std::size_t padded,
                 Layout& out) const;

    FormulaTape tape_;
    std::vector<std::uint32_t> slot_;      ///< register of each instruction
    std::vector<std::uint32_t> last_use_;  ///< scratch of `prepare`
    std::vector<std::uint32_t> free_;
    std::size_t slots_ = 0;
    std::vector<double> leaves_;  ///< constants, each repeated over a group
    Layout list_, lattice_;       ///< of the last grids of one line, and of more
};

/// Runs the steps in order over lines x points, points a multiple of batch_group (formula_batch_kernel.cpp).
void run_batch_steps(std::span<const BatchStep> steps, std::size_t lines, std::size_t points);

}  // namespace lamella
