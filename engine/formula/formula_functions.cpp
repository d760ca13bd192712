// Table of functions; each entry builds its function from operations.
#include "engine/formula/formula_functions.h"

#include <algorithm>
#include <array>

namespace lamella {
namespace {

using Node = FormulaBuilder::Node;
using Nodes = std::span<const Node>;
using Op = FormulaOp;

constexpr int any_number = 1'000'000;

template <FormulaOp op>
Node one(FormulaBuilder& f, Nodes a) {
    return f.unary(op, a[0]);
}

template <FormulaOp op>
Node two(FormulaBuilder& f, Nodes a) {
    return f.binary(op, a[0], a[1]);
}

/// Applies op to all arguments, paired as a balanced tree, so that a long list of min stays shallow.
template <FormulaOp op>
Node all(FormulaBuilder& f, Nodes a) {
    if (a.size() == 1) return a[0];
    const std::size_t half = a.size() / 2;
    return f.binary(op, all<op>(f, a.first(half)), all<op>(f, a.subspan(half)));
}

Node length(FormulaBuilder& f, Nodes a) {
    Node sum = f.unary(Op::square, a[0]);
    for (const Node b : a.subspan(1)) sum = f.binary(Op::add, sum, f.unary(Op::square, b));
    return f.unary(Op::sqrt, sum);
}

Node clamp(FormulaBuilder& f, Node x, Node lo, Node hi) {
    return f.binary(Op::min, f.binary(Op::max, x, lo), hi);
}

Node mix(FormulaBuilder& f, Node a, Node b, Node t) {
    return f.binary(Op::add, a, f.binary(Op::mul, f.binary(Op::sub, b, a), t));
}

Node smoothstep(FormulaBuilder& f, Nodes a) {
    const Node share = f.binary(Op::div, f.binary(Op::sub, a[2], a[0]), f.binary(Op::sub, a[1], a[0]));
    const Node t = clamp(f, share, f.constant(0), f.constant(1));
    const Node slope = f.binary(Op::sub, f.constant(3), f.binary(Op::mul, f.constant(2), t));
    return f.binary(Op::mul, f.unary(Op::square, t), slope);
}

constexpr std::array functions{
    FormulaFunction{"abs", 1, 1, one<Op::abs>},
    FormulaFunction{"acos", 1, 1, one<Op::acos>},
    FormulaFunction{"asin", 1, 1, one<Op::asin>},
    FormulaFunction{"atan", 1, 1, one<Op::atan>},
    FormulaFunction{"atan2", 2, 2, two<Op::atan2>},
    FormulaFunction{"blend", 3, 3,
                    [](FormulaBuilder& f, Nodes a) {
                        return mix(f, a[0], a[1], clamp(f, a[2], f.constant(0), f.constant(1)));
                    }},
    FormulaFunction{"ceil", 1, 1, one<Op::ceil>},
    FormulaFunction{"clamp", 3, 3, [](FormulaBuilder& f, Nodes a) { return clamp(f, a[0], a[1], a[2]); }},
    FormulaFunction{"cos", 1, 1, one<Op::cos>},
    FormulaFunction{"exp", 1, 1, one<Op::exp>},
    FormulaFunction{"floor", 1, 1, one<Op::floor>},
    FormulaFunction{"hypot", 2, any_number, length},
    FormulaFunction{"length", 2, any_number, length},
    FormulaFunction{"ln", 1, 1, one<Op::ln>},
    FormulaFunction{"log", 1, 1, one<Op::ln>},
    FormulaFunction{"log10", 1, 1,
                    [](FormulaBuilder& f, Nodes a) {
                        constexpr double ln10 = 2.302585092994045684;
                        return f.binary(Op::div, f.unary(Op::ln, a[0]), f.constant(ln10));
                    }},
    FormulaFunction{"max", 2, any_number, all<Op::max>},
    FormulaFunction{"min", 2, any_number, all<Op::min>},
    FormulaFunction{"mix", 3, 3, [](FormulaBuilder& f, Nodes a) { return mix(f, a[0], a[1], a[2]); }},
    FormulaFunction{"mod", 2, 2, two<Op::mod>},
    FormulaFunction{"pow", 2, 2, two<Op::pow>},
    FormulaFunction{"round", 1, 1, one<Op::round>},
    FormulaFunction{"sign", 1, 1,
                    [](FormulaBuilder& f, Nodes a) { return f.binary(Op::compare, a[0], f.constant(0)); }},
    FormulaFunction{"sin", 1, 1, one<Op::sin>},
    FormulaFunction{"smoothstep", 3, 3, smoothstep},
    FormulaFunction{"sqrt", 1, 1, one<Op::sqrt>},
    FormulaFunction{"square", 1, 1, one<Op::square>},
    FormulaFunction{"step", 2, 2, two<Op::less_equal>},
    FormulaFunction{"tan", 1, 1, one<Op::tan>},
};

}  // namespace

std::span<const FormulaFunction> formula_functions() { return functions; }

const FormulaFunction* find_formula_function(std::string_view name) {
    const auto found = std::find_if(functions.begin(), functions.end(),
                                    [&](const FormulaFunction& f) { return f.name == name; });
    return found == functions.end() ? nullptr : &*found;
}

std::optional<double> formula_constant(std::string_view name) {
    if (name == "pi") return 3.14159265358979323846;
    if (name == "tau") return 6.28318530717958647693;
    if (name == "e") return 2.71828182845904523536;
    return std::nullopt;
}

}  // namespace lamella
