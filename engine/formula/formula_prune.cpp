// Marks the instructions that the result needs, backward; then copies them forward, skipping decided choices
// and folding constants.
#include "engine/formula/formula_prune.h"

namespace lamella {
namespace {

/// Returns the operand that replaces a decided instruction.
std::uint32_t chosen(const FormulaInstruction& step, FormulaChoice choice) {
    const bool left = choice == FormulaChoice::left;
    if (step.op == FormulaOp::select) return left ? step.b : step.c;
    return left ? step.a : step.b;
}

}  // namespace

FormulaStack::FormulaStack(const Formula& formula, FormulaKeeps keeps) : keeps_(keeps) {
    const auto instructions = formula.instructions();
    const auto constants = formula.constants();
    // Every copy is shorter by a quarter, so all nested copies have less than four times the length in total,
    // and no reallocation moves a program in use.
    instructions_.reserve(4 * instructions.size());
    constants_.reserve(constants.size() + 4 * instructions.size());
    instructions_.assign(instructions.begin(), instructions.end());
    constants_.assign(constants.begin(), constants.end());
    levels_.push_back({0, instructions_.size(), constants_.size(), versions_, true});
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
    // Copying pays only if the copy is much shorter.
    const bool shrinks = (decided || keeps_ == FormulaKeeps::signs) && !settled;
    const std::size_t kept = shrinks ? mark_live(tape.instructions) : count;
    if (kept < count - count / 4) {
        shorten(parent, kept);
    } else {
        levels_.push_back({parent.begin, parent.end, parent.constants, parent.version, false});
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

void FormulaStack::choose_by_sign(const FormulaInstruction& step, FormulaChoice& choice) const {
    if (step.op != FormulaOp::min && step.op != FormulaOp::max) return;
    const auto never_decides = [&](std::uint32_t i) {
        const FormulaRange& r = ranges_[i];
        return !r.maybe_nan && (step.op == FormulaOp::min ? r.values.lo > 0 : r.values.hi < 0);
    };
    if (never_decides(step.a)) {
        choice = FormulaChoice::right;
    } else if (never_decides(step.b)) {
        choice = FormulaChoice::left;
    }
}

std::size_t FormulaStack::mark_live(std::span<const FormulaInstruction> parent) {
    std::fill_n(live_.begin(), parent.size(), static_cast<char>(dead));
    live_[parent.size() - 1] = keeps_ == FormulaKeeps::signs ? sign_matters : number_matters;
    std::size_t kept = 0;
    for (std::size_t i = parent.size(); i-- > 0;) {
        const char what = live_[i];
        if (what == dead) continue;
        const FormulaInstruction& step = parent[i];
        FormulaChoice& choice = choices_[i];
        if (what == sign_matters && choice == FormulaChoice::both) choose_by_sign(step, choice);
        if (choice != FormulaChoice::both) {
            need(chosen(step, choice), what);
            continue;
        }
        ++kept;
        const int arguments = arity(step.op);
        const bool passes =
            step.op == FormulaOp::min || step.op == FormulaOp::max || step.op == FormulaOp::neg;
        const char of_them = passes ? what : static_cast<char>(number_matters);
        if (arguments > 0) need(step.a, of_them);
        if (arguments > 1) need(step.b, arguments > 2 ? what : of_them);
        if (arguments > 2) need(step.c, what);
    }
    return kept;
}

/// Folds an operation on constants into a constant of the program.
FormulaInstruction FormulaStack::fold(const FormulaInstruction& step,
                                      std::span<const FormulaInstruction> made) {
    const double a = constants_[made[step.a].a];
    constants_.push_back(arity(step.op) == 1 ? apply(step.op, a)
                                             : apply(step.op, a, constants_[made[step.b].a]));
    return {FormulaOp::constant, static_cast<std::uint32_t>(constants_.size() - 1), 0, 0};
}

void FormulaStack::shorten(const Level& parent, std::size_t kept) {
    const std::size_t begin = instructions_.size();
    instructions_.resize(begin + kept);
    const std::span<const FormulaInstruction> old{instructions_.data() + parent.begin,
                                                  parent.end - parent.begin};
    const std::span<FormulaInstruction> made{instructions_.data() + begin, kept};
    std::uint32_t result = 0, count = 0;
    for (std::size_t i = 0; i < old.size(); ++i) {
        if (live_[i] == dead) continue;
        FormulaInstruction step = old[i];
        if (choices_[i] != FormulaChoice::both) {
            result = place_[i] = place_[chosen(step, choices_[i])];
            continue;
        }
        const int arguments = arity(step.op);
        if (arguments > 0) {
            step.a = place_[step.a];
            if (arguments > 1) step.b = place_[step.b];
            if (arguments > 2) step.c = place_[step.c];
            const bool constant = made[step.a].op == FormulaOp::constant && arguments < 3 &&
                                  (arguments == 1 || made[step.b].op == FormulaOp::constant);
            if (constant) step = fold(step, made);
        }
        made[count] = step;
        ranges_[count] = ranges_[i];
        result = place_[i] = count++;
    }
    // The result is the last instruction; those behind it belong to choices that were decided.
    instructions_.resize(begin + result + 1);
    levels_.push_back({begin, instructions_.size(), constants_.size(), ++versions_, true});
}

}  // namespace lamella
