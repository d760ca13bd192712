// Hash-consing: each node is looked up by operation and operands before it is made.
#include "engine/formula/formula_builder.h"

#include <bit>

#include "engine/base/error.h"

namespace lamella {
namespace {

bool commutes(FormulaOp op) { return op == FormulaOp::add || op == FormulaOp::mul || op == FormulaOp::equal; }

}  // namespace

std::size_t FormulaBuilder::KeyHash::operator()(const Key& key) const {
    std::uint64_t h = static_cast<std::uint64_t>(key.op);
    for (const std::uint64_t part : {key.a, key.b, key.c}) {
        h = (h ^ part) * 0x9E3779B97F4A7C15ULL;
        h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
}

FormulaBuilder::Node FormulaBuilder::add(FormulaOp op, std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    const auto [place, added] = known_.try_emplace(Key{op, a, b, c}, static_cast<Node>(nodes_.size()));
    if (!added) return place->second;
    if (nodes_.size() >= static_cast<std::size_t>(max_nodes))
        throw InputError("the formula has more than " + std::to_string(max_nodes) + " operations");
    if (op == FormulaOp::constant) {
        constants_.push_back(std::bit_cast<double>(a));
        a = constants_.size() - 1;
    }
    nodes_.push_back(
        {op, static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    return place->second;
}

const double* FormulaBuilder::value_of(Node node) const {
    const FormulaInstruction& i = nodes_[static_cast<std::size_t>(node)];
    return i.op == FormulaOp::constant ? &constants_[i.a] : nullptr;
}

std::optional<double> FormulaBuilder::number_of(Node node) const {
    const double* const value = value_of(node);
    return value == nullptr ? std::nullopt : std::optional(*value);
}

FormulaBuilder::Node FormulaBuilder::input(int number) {
    if (number < 0 || number >= max_inputs)
        throw InputError("a formula has at most " + std::to_string(max_inputs) + " inputs");
    if (const auto fixed = fixed_.find(number); fixed != fixed_.end()) return constant(fixed->second);
    return add(FormulaOp::input, static_cast<std::uint64_t>(number), 0, 0);
}

FormulaBuilder::Node FormulaBuilder::constant(double value) {
    return add(FormulaOp::constant, std::bit_cast<std::uint64_t>(value), 0, 0);
}

FormulaBuilder::Node FormulaBuilder::unary(FormulaOp op, Node a) {
    if (const double* v = value_of(a)) return constant(apply(op, *v));
    const FormulaInstruction& inner = nodes_[static_cast<std::size_t>(a)];
    if (op == FormulaOp::neg && inner.op == FormulaOp::neg) return static_cast<Node>(inner.a);
    return add(op, static_cast<std::uint64_t>(a), 0, 0);
}

FormulaBuilder::Node FormulaBuilder::whole_power(Node base, int exponent) {
    const Node product = multiply_out(base, std::abs(exponent),
                                      [this](Node a, Node b) { return binary(FormulaOp::mul, a, b); });
    return exponent < 0 ? unary(FormulaOp::recip, product) : product;
}

FormulaBuilder::Node FormulaBuilder::binary(FormulaOp op, Node a, Node b) {
    const double* const v = value_of(a);
    const double* const w = value_of(b);
    if (v != nullptr && w != nullptr) return constant(apply(op, *v, *w));
    const bool by_one = w != nullptr && *w == 1, one_by = v != nullptr && *v == 1;
    if ((op == FormulaOp::mul || op == FormulaOp::div) && by_one) return a;
    if (op == FormulaOp::mul && one_by) return b;
    if (op == FormulaOp::mul && a == b) return unary(FormulaOp::square, a);
    if (op == FormulaOp::div && one_by) return unary(FormulaOp::recip, b);
    if ((op == FormulaOp::min || op == FormulaOp::max) && a == b) return a;
    const bool whole = w != nullptr && *w == std::floor(*w) && *w != 0 && std::fabs(*w) <= max_multiplied;
    if (op == FormulaOp::pow && whole) return whole_power(a, static_cast<int>(*w));
    if (commutes(op) && b < a) std::swap(a, b);
    return add(op, static_cast<std::uint64_t>(a), static_cast<std::uint64_t>(b), 0);
}

FormulaBuilder::Node FormulaBuilder::select(Node condition, Node yes, Node no) {
    if (const double* v = value_of(condition)) return *v != 0 ? yes : no;
    if (yes == no) return yes;
    return add(FormulaOp::select, static_cast<std::uint64_t>(condition), static_cast<std::uint64_t>(yes),
               static_cast<std::uint64_t>(no));
}

FormulaBuilder::Node FormulaBuilder::include(const Formula& formula) {
    std::vector<Node> nodes;
    nodes.reserve(formula.instructions().size());
    for (const FormulaInstruction& step : formula.instructions()) {
        if (step.op == FormulaOp::input) {
            nodes.push_back(input(static_cast<int>(step.a)));
        } else if (step.op == FormulaOp::constant) {
            nodes.push_back(constant(formula.constants()[step.a]));
        } else if (arity(step.op) == 1) {
            nodes.push_back(unary(step.op, nodes[step.a]));
        } else if (arity(step.op) == 2) {
            nodes.push_back(binary(step.op, nodes[step.a], nodes[step.b]));
        } else {
            nodes.push_back(select(nodes[step.a], nodes[step.b], nodes[step.c]));
        }
    }
    return nodes.back();
}

Formula FormulaBuilder::finish(Node result) const {
    const auto last = static_cast<std::size_t>(result);
    std::vector<char> used(last + 1, 0);
    used[last] = 1;
    for (std::size_t i = last + 1; i-- > 0;) {
        const int arguments = used[i] != 0 ? arity(nodes_[i].op) : 0;
        if (arguments > 0) used[nodes_[i].a] = 1;
        if (arguments > 1) used[nodes_[i].b] = 1;
        if (arguments > 2) used[nodes_[i].c] = 1;
    }
    std::vector<FormulaInstruction> kept;
    std::vector<double> constants;
    std::vector<std::uint32_t> place(last + 1, 0);
    for (std::size_t i = 0; i <= last; ++i) {
        if (used[i] == 0) continue;
        FormulaInstruction step = nodes_[i];
        const int arguments = arity(step.op);
        if (step.op == FormulaOp::constant) {
            constants.push_back(constants_[step.a]);
            step.a = static_cast<std::uint32_t>(constants.size() - 1);
        }
        if (arguments > 0) step.a = place[step.a];
        if (arguments > 1) step.b = place[step.b];
        if (arguments > 2) step.c = place[step.c];
        place[i] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(step);
    }
    return {std::move(kept), std::move(constants)};
}

}  // namespace lamella
