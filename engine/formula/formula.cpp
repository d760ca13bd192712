// The point evaluator: a loop over operations on registers, which are reused as soon as they are free.
#include "engine/formula/formula.h"

#include <algorithm>
#include <array>

namespace lamella {

Formula::Formula(std::vector<FormulaInstruction> instructions, std::vector<double> constants)
    : instructions_(std::move(instructions)), constants_(std::move(constants)) {
    for (const FormulaInstruction& i : instructions_) {
        if (i.op == FormulaOp::input) input_count_ = std::max(input_count_, static_cast<int>(i.a) + 1);
    }
    assign_registers();
}

bool Formula::reads(int input) const {
    return std::any_of(instructions_.begin(), instructions_.end(), [&](const FormulaInstruction& i) {
        return i.op == FormulaOp::input && i.a == static_cast<std::uint32_t>(input);
    });
}

void Formula::assign_registers() {
    const std::size_t count = instructions_.size();
    constexpr std::uint32_t never = 0xFFFFFFFF;
    std::vector<std::uint32_t> last_use(count, never), place(count);
    const auto operands = [](const FormulaInstruction& i) { return std::array{i.a, i.b, i.c}; };
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto used = operands(instructions_[i]);
        for (int k = 0; k < arity(instructions_[i].op); ++k) last_use[used[static_cast<std::size_t>(k)]] = i;
    }
    const auto inputs = static_cast<std::uint32_t>(input_count_);
    std::uint32_t next = inputs + static_cast<std::uint32_t>(constants_.size());
    std::vector<std::uint32_t> free;
    for (std::uint32_t i = 0; i < count; ++i) {
        const FormulaInstruction& step = instructions_[i];
        const int arguments = arity(step.op);
        if (arguments == 0) {
            place[i] = step.op == FormulaOp::input ? step.a : inputs + step.a;
            continue;
        }
        const auto used = operands(step);
        for (int k = 0; k < arguments; ++k) {
            const std::uint32_t operand = used[static_cast<std::size_t>(k)];
            if (last_use[operand] != i || arity(instructions_[operand].op) == 0) continue;
            free.push_back(place[operand]);
            last_use[operand] = never;
        }
        if (free.empty()) free.push_back(next++);
        place[i] = free.back();
        free.pop_back();
        const auto at = [&](std::size_t k) {
            return k < static_cast<std::size_t>(arguments) ? place[used[k]] : 0;
        };
        steps_.push_back({step.op, place[i], at(0), at(1), at(2)});
    }
    registers_ = next;
    result_ = place.back();
}

double Formula::at(std::span<const double> inputs) const {
    std::array<double, 256> few;
    std::vector<double> many;
    if (registers_ > few.size()) many.resize(registers_);
    double* const r = many.empty() ? few.data() : many.data();
    std::copy_n(inputs.begin(), input_count_, r);
    std::copy(constants_.begin(), constants_.end(), r + input_count_);
    for (const Step& step : steps_) {
        switch (arity(step.op)) {
            case 1:
                r[step.out] = apply(step.op, r[step.a]);
                break;
            case 2:
                r[step.out] = apply(step.op, r[step.a], r[step.b]);
                break;
            default:
                r[step.out] = r[step.a] != 0 ? r[step.b] : r[step.c];
        }
    }
    return r[result_];
}

}  // namespace lamella
