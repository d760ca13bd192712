// Registers by liveness, one for each leaf and each live result; then the kernel runs the steps.
#include "engine/formula_batch.h"

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
        // Inputs are loaded before the first step runs, so they share their registers with nothing.
        if (tape.instructions[i].op == FormulaOp::input) slot_[i] = static_cast<std::uint32_t>(slots_++);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const FormulaOp op = tape.instructions[i].op;
        if (arity(op) == 0) continue;
        const auto used = operands(i);
        const auto arguments = static_cast<std::size_t>(arity(op));
        // A result may not overwrite its operand: they may be laid out differently.
        if (free_.empty()) free_.push_back(static_cast<std::uint32_t>(slots_++));
        slot_[i] = free_.back();
        free_.pop_back();
        for (std::size_t k = 0; k < arguments; ++k) {
            if (last_use_[used[k]] != i || arity(tape.instructions[used[k]].op) == 0) continue;
            free_.push_back(slot_[used[k]]);
            last_use_[used[k]] = never;
        }
    }
    load_constants();
}

void FormulaBatch::load_constants() {
    leaves_.clear();
    for (const FormulaInstruction& step : tape_.instructions) {
        if (step.op == FormulaOp::constant)
            leaves_.insert(leaves_.end(), batch_group, tape_.constants[step.a]);
    }
}

/// Brings an input into groups: padded along the line, or repeated over a group.
void FormulaBatch::load_input(const BatchInput& input, Place& place) {
    double* const to = const_cast<double*>(place.operand.at);
    const std::size_t lines = input.by_line ? lines_ : 1;
    for (std::size_t l = 0; l < lines; ++l) {
        const double* const from = input.numbers + l * (input.by_point ? points_ : 1);
        double* const line = to + l * (input.by_point ? padded_ : batch_group);
        if (input.by_point) {
            std::copy_n(from, points_, line);
            std::fill(line + points_, line + padded_, from[points_ - 1]);
        } else {
            std::fill_n(line, batch_group, *from);
        }
    }
}

void FormulaBatch::run(std::span<const BatchInput> inputs, int lines, int points, std::span<double> out) {
    lines_ = static_cast<std::size_t>(lines);
    points_ = static_cast<std::size_t>(points);
    padded_ = (points_ + batch_group - 1) / batch_group * batch_group;
    capacity_ = lines_ * padded_;
    if (registers_.size() < slots_ * capacity_) registers_.resize(slots_ * capacity_);
    const std::size_t count = tape_.instructions.size();
    places_.resize(count);
    steps_.clear();
    std::size_t leaf = 0;
    const auto place_of = [&](std::size_t slot, std::uint8_t varies) {
        const bool by_point = (varies & varies_by_point) != 0, by_line = (varies & varies_by_line) != 0;
        const std::size_t stride = by_point ? padded_ : batch_group;
        return Place{{buffer(slot), by_line ? stride : 0, by_point ? ~std::size_t{0} : 0}, varies};
    };
    for (std::size_t i = 0; i < count; ++i) {
        const FormulaInstruction& step = tape_.instructions[i];
        if (step.op == FormulaOp::constant) {
            places_[i] = {{leaves_.data() + batch_group * leaf++, 0, 0}, 0};
        } else if (step.op == FormulaOp::input) {
            const BatchInput& input = inputs[step.a];
            const int varies = (input.by_point ? varies_by_point : 0) | (input.by_line ? varies_by_line : 0);
            places_[i] = place_of(slot_[i], static_cast<std::uint8_t>(varies));
            load_input(input, places_[i]);
        } else {
            const int arguments = arity(step.op);
            const Place& a = places_[step.a];
            const Place& b = arguments > 1 ? places_[step.b] : a;
            const Place& c = arguments > 2 ? places_[step.c] : a;
            const int varies = a.varies | b.varies | c.varies;
            places_[i] = place_of(slot_[i], static_cast<std::uint8_t>(varies));
            const Place& own = places_[i];
            BatchStep made{step.op,   buffer(slot_[i]), own.operand.line_stride, 1, batch_group, a.operand,
                           b.operand, c.operand};
            if ((varies & varies_by_point) != 0) made.points = padded_;
            if ((varies & varies_by_line) != 0) made.lines = lines_;
            steps_.push_back(made);
        }
    }
    run_batch_steps(steps_);
    const BatchStep::Operand& result = places_[count - 1].operand;
    for (std::size_t l = 0; l < lines_; ++l) {
        const double* const line = result.at + l * result.line_stride;
        double* const to = out.data() + l * points_;
        if (result.point_mask != 0) {
            std::copy_n(line, points_, to);
        } else {
            std::fill_n(to, points_, *line);
        }
    }
}

}  // namespace lamella
