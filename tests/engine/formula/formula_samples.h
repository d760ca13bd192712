// Random formulas and inputs for the tests of formulas.
#pragma once

#include <bit>
#include <random>
#include <vector>

#include "engine/formula/formula_builder.h"

namespace lamella::samples {

inline std::vector<FormulaOp> ops_of(int arguments) {
    std::vector<FormulaOp> ops;
    for (int i = 0; i < formula_op_count; ++i) {
        if (arity(static_cast<FormulaOp>(i)) == arguments) ops.push_back(static_cast<FormulaOp>(i));
    }
    return ops;
}

/// Numbers where things go wrong, and ordinary ones.
inline double awkward_number(std::mt19937& random) {
    static const std::vector<double> special{
        0.0,  -0.0,  1.0,      -1.0,      0.5, -0.5, 2.0, 3.0,  1e-300, -1e300, 1e308, 5e-324,
        1e15, -1e16, INFINITY, -INFINITY, NAN, 1.5,  2.5, -2.5, 709.9,  -745.0, 1e5,   0.49999999999999994};
    std::uniform_int_distribution<std::size_t> kind(0, 2 * special.size());
    const std::size_t k = kind(random);
    if (k < special.size()) return special[k];
    return std::uniform_real_distribution<double>(-8, 8)(random);
}

/// A program of about `size` operations over `inputs` inputs; `any` node may be an operand.
inline Formula random_formula(std::mt19937& random, int inputs, int size) {
    FormulaBuilder f;
    std::vector<FormulaBuilder::Node> nodes;
    for (int i = 0; i + 1 < inputs; ++i) nodes.push_back(f.input(i));
    for (int i = 0; i < 4; ++i) nodes.push_back(f.constant(awkward_number(random)));
    for (int i = 0; i < 3; ++i)
        nodes.push_back(f.constant(std::uniform_real_distribution<double>(-3, 3)(random)));
    const auto unary = ops_of(1), binary = ops_of(2);
    const auto pick = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    for (int i = 0; i < size; ++i) {
        if (i == size / 2) nodes.push_back(f.input(inputs - 1));
        // Recent nodes are likelier, so that programs get deep.
        const auto node = [&] {
            const std::size_t back = std::min(pick(nodes.size()), pick(nodes.size()));
            return nodes[nodes.size() - 1 - back];
        };
        const std::size_t kind = pick(10);
        if (kind < 3) {
            nodes.push_back(f.unary(unary[pick(unary.size())], node()));
        } else if (kind < 9) {
            const bool choosing = pick(3) == 0;
            const FormulaOp op =
                choosing ? (pick(2) == 0 ? FormulaOp::min : FormulaOp::max) : binary[pick(binary.size())];
            const auto a = node(), b = node();
            nodes.push_back(f.binary(op, a, b));
        } else {
            const auto a = node(), b = node(), c = node();
            nodes.push_back(f.select(a, b, c));
        }
    }
    return f.finish(nodes.back());
}

/// A program of about `size` operations over three inputs that is seldom NaN, infinite or a jump.
inline Formula tame_formula(std::mt19937& random, int size) {
    using enum FormulaOp;
    static constexpr FormulaOp unary[] = {neg, abs, square, FormulaOp::sqrt, recip, sin, cos, exp, ln, atan};
    static constexpr FormulaOp binary[] = {add, add, sub, sub, mul, mul, div, min, max};
    FormulaBuilder f;
    std::vector<FormulaBuilder::Node> nodes{f.input(0), f.input(1), f.input(2), f.input(0)};
    const auto node = [&] {
        return nodes[nodes.size() - 1 - random() % std::min<std::size_t>(nodes.size(), 5)];
    };
    for (int i = 0; i < size; ++i) {
        nodes.push_back(f.constant(std::uniform_real_distribution<double>(-3, 3)(random)));
        const auto a = node(), b = node();
        nodes.push_back(random() % 3 == 0 ? f.unary(unary[random() % std::size(unary)], a)
                                          : f.binary(binary[random() % std::size(binary)], a, b));
    }
    return f.finish(nodes.back());
}

/// Equal bit for bit, where all NaN are alike.
inline bool same_number(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace lamella::samples
