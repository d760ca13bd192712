// Marks backward what the result needs, then copies it forward, skipping decided choices and working out
// constants.
#include "engine/formula_prune.h"

#include <algorithm>
namespace lamella {
namespace {

/// The operand that a decided instruction stands for.
std::uint32_t chosen(const FormulaInstruction& step, FormulaChoice choice) {
    const bool left = choice == FormulaChoice::left;
    if (step.op == FormulaOp::select) return left ? step.b : step.c;
    return left ? step.a : step.b;
}

}  // namespace

FormulaStack::FormulaStack(const Formula& formula)
    : instructions_(formula.instructions().begin(), formula.instructions().end()),
      constants_(formula.constants().begin(), formula.constants().end()) {
    levels_.push_back({0, instructions_.size(), constants_.size(), true});
}

FormulaTape FormulaStack::tape() const {
    const Level& top = levels_.back();
    return {{instructions_.data() + top.begin, top.end - top.begin}, {constants_.data(), top.constants}};
}

FormulaRange FormulaStack::enter(std::span<const FormulaRange> inputs) {
    const Level parent = levels_.back();
    const FormulaTape tape = this->tape();
    const std::size_t count = tape.instructions.size();
    if (ranges_.size() < count) {
        ranges_.resize(count);
        choices_.resize(count);
        place_.resize(count);
        live_.resize(count);
    }
    const bool decided = interval_run(tape.instructions, tape.constants, inputs, ranges_, choices_);
    const FormulaRange result = ranges_[count - 1];
    const bool settled = result.values.lo > 0 || (result.values.hi < 0 && !result.maybe_nan);
    if (!decided || settled) {
        levels_.push_back({parent.begin, parent.end, parent.constants, false});
    } else {
        mark_live(tape.instructions);
        shorten(parent);
    }
    return result;
}

void FormulaStack::leave() {
    const Level top = levels_.back();
    levels_.pop_back();
    if (!top.own) return;
    instructions_.resize(top.begin);
    constants_.resize(levels_.back().constants);
}

void FormulaStack::mark_live(std::span<const FormulaInstruction> parent) {
    std::fill_n(live_.begin(), parent.size(), static_cast<char>(0));
    live_[parent.size() - 1] = 1;
    for (std::size_t i = parent.size(); i-- > 0;) {
        if (live_[i] == 0) continue;
        const FormulaInstruction& step = parent[i];
        if (choices_[i] != FormulaChoice::both) {
            live_[chosen(step, choices_[i])] = 1;
            continue;
        }
        const int arguments = arity(step.op);
        if (arguments > 0) live_[step.a] = 1;
        if (arguments > 1) live_[step.b] = 1;
        if (arguments > 2) live_[step.c] = 1;
    }
}

/// Appends an instruction of the new program, or the constant that it comes to.
std::uint32_t FormulaStack::emit(FormulaInstruction step, std::size_t begin) {
    const int arguments = arity(step.op);
    const auto constant_at = [&](std::uint32_t i) -> const double* {
        const FormulaInstruction& operand = instructions_[begin + i];
        return operand.op == FormulaOp::constant ? &constants_[operand.a] : nullptr;
    };
    const double* const a = arguments > 0 ? constant_at(step.a) : nullptr;
    const double* const b = arguments > 1 ? constant_at(step.b) : nullptr;
    if (a != nullptr && (arguments == 1 || (arguments == 2 && b != nullptr))) {
        const double value = arguments == 1 ? apply(step.op, *a) : apply(step.op, *a, *b);
        step = {FormulaOp::constant, static_cast<std::uint32_t>(constants_.size()), 0, 0};
        constants_.push_back(value);
    }
    instructions_.push_back(step);
    return static_cast<std::uint32_t>(instructions_.size() - 1 - begin);
}

void FormulaStack::shorten(const Level& parent) {
    const std::size_t begin = instructions_.size();
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < parent.end - parent.begin; ++i) {
        if (live_[i] == 0) continue;
        FormulaInstruction step = instructions_[parent.begin + i];
        if (choices_[i] != FormulaChoice::both) {
            result = place_[i] = place_[chosen(step, choices_[i])];
            continue;
        }
        const int arguments = arity(step.op);
        if (arguments > 0) step.a = place_[step.a];
        if (arguments > 1) step.b = place_[step.b];
        if (arguments > 2) step.c = place_[step.c];
        result = place_[i] = emit(step, begin);
    }
    // The result stands last; what follows it was made for choices that fell away.
    instructions_.resize(begin + result + 1);
    levels_.push_back({begin, instructions_.size(), constants_.size(), true});
}

}  // namespace lamella
