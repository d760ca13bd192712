// FormulaBatch: evaluates formulas at many points by SIMD, with the same bits at every point as Formula::at.
#pragma once

#include <vector>

#include "engine/formula/formula_prune.h"

namespace lamella {

/// An input on a grid of lines x points. A dimension along which it does not vary is left out: an input that
/// varies along neither is a single number.
struct BatchInput {
    const double* numbers = nullptr;  ///< numbers[line * points + point], without dimensions that do not vary
    bool by_line = false;
    bool by_point = false;
};

/// One step over a grid, for the kernel: numbers are stored in groups of `batch_group` along a line.
struct BatchStep {
    struct Operand {
        const double* at;
        std::size_t line_stride;  ///< 0 if all lines are equal
        std::size_t point_mask;   ///< 0 if all points of a line are equal, else all ones
    };
    FormulaOp op;
    bool by_line, by_point;
    bool contiguous;  ///< the operands have the layout of the result, or are single numbers
    double* out;
    std::size_t out_stride;
    Operand a, b, c;
};

/// Group size: a multiple of the vector length of every target.
inline constexpr std::size_t batch_group = 8;

/// Evaluates programs over grids. Parts of a program that depend only on the point within the line, or only
/// on the line, are computed once for it. Keeps its registers for the next grid; not thread-safe.
class FormulaBatch {
  public:
    /// Number of grid values at which programs are fastest: the registers fit the first-level cache.
    static constexpr int good_grid = 512;

    /// Sets the program to evaluate; it must outlive the calls of `run`.
    void prepare(const FormulaTape& tape);
    /// Computes the prepared program: out[line * points + point]. inputs[i] is input i; inputs that the
    /// program does not read may be missing.
    void run(std::span<const BatchInput> inputs, int lines, int points, std::span<double> out);

  private:
    enum : std::uint8_t { varies_by_point = 1, varies_by_line = 2 };
    struct Place {
        BatchStep::Operand operand;
        std::uint8_t varies;
    };
    /// An input that the program reads, and the register to copy it to.
    struct Load {
        std::uint32_t input;
        double* to;
    };
    /// Registers and steps for grids of one layout. Lists of points share one, whatever their length.
    struct Layout {
        std::size_t lines = 0, padded = 0;  ///< capacity; none before the first run
        std::vector<std::uint8_t> varies;   ///< per input
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
    std::vector<std::uint32_t> last_use_;  ///< temporary in `prepare`
    std::vector<std::uint32_t> free_;
    std::size_t slots_ = 0;
    std::vector<double> leaves_;  ///< constants, each repeated over a group
    Layout list_, lattice_;       ///< of the last grids with one line, and with more
};

/// Runs the steps in order over lines x points; points is a multiple of batch_group
/// (formula_batch_kernel.cpp).
void run_batch_steps(std::span<const BatchStep> steps, std::size_t lines, std::size_t points);

}  // namespace lamella
