// Allocates registers by liveness, one for each leaf and each live result; then the kernel runs the steps.
#include "engine/formula/formula_batch.h"

#include <algorithm>
#include <array>

namespace lamella {

void FormulaBatch::prepare(const FormulaTape& tape) {
    tape_ = tape;
    const std::size_t count = tape.instructions.size();
    constexpr std::uint32_t never = 0xFFFFFFFF;
    last_use_.assign(count, never);
    slot_.assign(count, never);
    free_.clear();
    slots_ = 0;
    const auto operands = [&](std::size_t i) {
        const FormulaInstruction& step = tape.instructions[i];
        return std::array{step.a, step.b, step.c};
    };
    for (std::size_t i = 0; i < count; ++i) {
        const auto used = operands(i);
        const auto arguments = static_cast<std::size_t>(arity(tape.instructions[i].op));
        for (std::size_t k = 0; k < arguments; ++k) last_use_[used[k]] = static_cast<std::uint32_t>(i);
        // Inputs are loaded before the first step runs, so each has a register of its own.
        if (tape.instructions[i].op == FormulaOp::input) slot_[i] = static_cast<std::uint32_t>(slots_++);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const FormulaOp op = tape.instructions[i].op;
        if (arity(op) == 0) continue;
        const auto used = operands(i);
        const auto arguments = static_cast<std::size_t>(arity(op));
        // A result must not overwrite its operand, because their layouts may differ.
        if (free_.empty()) free_.push_back(static_cast<std::uint32_t>(slots_++));
        slot_[i] = free_.back();
        free_.pop_back();
        for (std::size_t k = 0; k < arguments; ++k) {
            if (last_use_[used[k]] != i || arity(tape.instructions[used[k]].op) == 0) continue;
            free_.push_back(slot_[used[k]]);
            last_use_[used[k]] = never;
        }
    }
    leaves_.clear();
    for (const FormulaInstruction& step : tape.instructions) {
        if (step.op == FormulaOp::constant)
            leaves_.insert(leaves_.end(), batch_group, tape.constants[step.a]);
    }
    list_.lines = lattice_.lines = 0;
}

bool FormulaBatch::Layout::fits(std::span<const BatchInput> inputs, std::size_t line_count,
                                std::size_t width) const {
    const bool roomy = line_count == lines && (lines == 1 ? width <= padded : width == padded);
    return roomy && std::all_of(loads.begin(), loads.end(), [&](const Load& l) {
               const BatchInput& input = inputs[l.input];
               const int how = (input.by_point ? varies_by_point : 0) | (input.by_line ? varies_by_line : 0);
               return varies[l.input] == how;
           });
}

FormulaBatch::Place FormulaBatch::Layout::place(std::uint32_t slot, int varies_how) const {
    const bool by_point = (varies_how & varies_by_point) != 0, by_line = (varies_how & varies_by_line) != 0;
    const std::size_t stride = by_point ? padded : batch_group;
    const double* const at = registers.data() + slot * (lines * padded);
    return {{at, by_line ? stride : 0, by_point ? ~std::size_t{0} : 0},
            static_cast<std::uint8_t>(varies_how)};
}

void FormulaBatch::lay_out(std::span<const BatchInput> inputs, std::size_t lines, std::size_t padded,
                           Layout& out) const {
    out.lines = lines;
    // Lists of points vary in length; room for the usual size avoids a new layout each time.
    out.padded = lines == 1 ? std::max(padded, std::size_t{good_grid}) : padded;
    const std::size_t room = slots_ * out.lines * out.padded, count = tape_.instructions.size();
    if (out.registers.size() < room) out.registers.resize(room);
    out.places.resize(count);
    out.steps.clear();
    out.loads.clear();
    out.varies.resize(std::max(out.varies.size(), inputs.size()));
    auto& places = out.places;
    const double* leaf = leaves_.data();
    for (std::size_t i = 0; i < count; ++i) {
        const FormulaInstruction& step = tape_.instructions[i];
        if (step.op == FormulaOp::constant) {
            places[i] = {{leaf, 0, 0}, 0};
            leaf += batch_group;
            continue;
        }
        if (step.op == FormulaOp::input) {
            const BatchInput& input = inputs[step.a];
            places[i] = out.place(
                slot_[i], (input.by_point ? varies_by_point : 0) | (input.by_line ? varies_by_line : 0));
            out.varies[step.a] = places[i].varies;
            out.loads.push_back({step.a, const_cast<double*>(places[i].operand.at)});
            continue;
        }
        const int arguments = arity(step.op);
        const Place& a = places[step.a];
        const Place& b = arguments > 1 ? places[step.b] : a;
        const Place& c = arguments > 2 ? places[step.c] : a;
        places[i] = out.place(slot_[i], a.varies | b.varies | c.varies);
        const Place& own = places[i];
        const auto alike = [&](const Place& place) {
            return place.varies == own.varies || place.varies == 0;
        };
        const bool contiguous =
            own.varies == (varies_by_line | varies_by_point) && alike(a) && alike(b) && alike(c);
        out.steps.push_back({step.op, (own.varies & varies_by_line) != 0, (own.varies & varies_by_point) != 0,
                             contiguous, const_cast<double*>(own.operand.at), own.operand.line_stride,
                             a.operand, b.operand, c.operand});
    }
}

/// Copies an input into groups: padded along the line, or repeated over a group.
void FormulaBatch::Layout::load(const BatchInput& input, double* to, std::size_t points,
                                std::size_t width) const {
    for (std::size_t l = 0; l < (input.by_line ? lines : 1); ++l) {
        if (input.by_point) {
            const double* const from = input.numbers + l * points;
            std::copy_n(from, points, to);
            std::fill(to + points, to + width, from[points - 1]);
            to += padded;
        } else {
            std::fill_n(to, batch_group, input.numbers[l]);
            to += batch_group;
        }
    }
}

void FormulaBatch::run(std::span<const BatchInput> inputs, int line_count, int point_count,
                       std::span<double> out) {
    const auto lines = static_cast<std::size_t>(line_count), points = static_cast<std::size_t>(point_count);
    const std::size_t padded = (points + batch_group - 1) / batch_group * batch_group;
    Layout& layout = lines == 1 ? list_ : lattice_;
    if (!layout.fits(inputs, lines, padded)) lay_out(inputs, lines, padded, layout);
    for (const Load& l : layout.loads) layout.load(inputs[l.input], l.to, points, padded);
    run_batch_steps(layout.steps, lines, padded);
    const BatchStep::Operand& result = layout.places[tape_.instructions.size() - 1].operand;
    for (std::size_t l = 0; l < lines; ++l) {
        const double* const line = result.at + l * result.line_stride;
        double* const to = out.data() + l * points;
        if (result.point_mask != 0) {
            std::copy_n(line, points, to);
        } else {
            std::fill_n(to, points, *line);
        }
    }
}

}  // namespace lamella
