// FormulaOp: the operations of formulas, and their exact results.
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/base/deterministic_math.h"

namespace lamella {

/// Operation of an instruction. A number is true when it is not zero (NaN is true). Operations with a NaN
/// argument give NaN, except comparisons (false) and logical operations, which return one of their arguments.
enum class FormulaOp : std::uint8_t {
    input,     ///< leaf
    constant,  ///< leaf
    neg,
    abs,
    square,
    sqrt,   ///< NaN below zero
    recip,  ///< 1 / a
    floor,
    ceil,
    round,      ///< to the nearest whole number, halves away from zero
    logic_not,  ///< 1 where a is zero, else 0
    sin,        ///< radians, as all angles here
    cos,
    tan,
    asin,
    acos,
    atan,
    exp,
    ln,
    add,  ///< the first operation with two arguments
    sub,
    mul,
    div,
    mod,         ///< least non-negative remainder: a - |b| floor(a / |b|), kept within [0, |b|]
    pow,         ///< see power()
    atan2,       ///< the angle of the point (b, a)
    min,         ///< a where a < b, else b; NaN if either is
    max,         ///< a where a > b, else b; NaN if either is
    compare,     ///< -1, 0 or 1 as a is less than, equal to or greater than b
    less,        ///< 1 where a < b, else 0
    less_equal,  ///< 1 where a <= b, else 0
    equal,       ///< 1 where a == b, else 0
    logic_and,   ///< a where a is zero, else b
    logic_or,    ///< a where a is not zero, else b
    select       ///< three arguments: b where a is not zero, else c
};

inline constexpr int formula_op_count = static_cast<int>(FormulaOp::select) + 1;

/// Returns the number of arguments: 0 for leaves, 1, 2 or 3.
constexpr int arity(FormulaOp op) {
    if (op <= FormulaOp::constant) return 0;
    if (op < FormulaOp::add) return 1;
    return op < FormulaOp::select ? 2 : 3;
}

inline double formula_round(double a) {
    const double magnitude = std::fabs(a), whole = std::floor(magnitude);
    return std::copysign(whole + (magnitude - whole >= 0.5 ? 1.0 : 0.0), a);
}

inline double formula_mod(double a, double b) {
    const double size = std::fabs(b);
    const double rest = a - size * std::floor(a / size);
    return rest < 0 ? 0 : size < rest ? size : rest;
}

inline double formula_min(double a, double b) { return std::isnan(a) || a < b ? a : b; }
inline double formula_max(double a, double b) { return std::isnan(a) || b < a ? a : b; }

/// Returns the result of an operation with one argument.
inline double apply(FormulaOp op, double a) {
    switch (op) {
        case FormulaOp::neg:
            return -a;
        case FormulaOp::abs:
            return std::fabs(a);
        case FormulaOp::square:
            return a * a;
        case FormulaOp::sqrt:
            return std::sqrt(a);
        case FormulaOp::recip:
            return 1 / a;
        case FormulaOp::floor:
            return std::floor(a);
        case FormulaOp::ceil:
            return std::ceil(a);
        case FormulaOp::round:
            return formula_round(a);
        case FormulaOp::logic_not:
            return a == 0 ? 1 : 0;
        case FormulaOp::sin:
            return sine(a);
        case FormulaOp::cos:
            return cosine(a);
        case FormulaOp::tan:
            return tangent(a);
        case FormulaOp::asin:
            return arcsine(a);
        case FormulaOp::acos:
            return arccosine(a);
        case FormulaOp::atan:
            return arctangent(a);
        case FormulaOp::exp:
            return exponential(a);
        default:
            return logarithm(a);
    }
}

/// Returns the result of an operation with two arguments.
inline double apply(FormulaOp op, double a, double b) {
    switch (op) {
        case FormulaOp::add:
            return a + b;
        case FormulaOp::sub:
            return a - b;
        case FormulaOp::mul:
            return a * b;
        case FormulaOp::div:
            return a / b;
        case FormulaOp::mod:
            return formula_mod(a, b);
        case FormulaOp::pow:
            return power(a, b);
        case FormulaOp::atan2:
            return arctangent2(a, b);
        case FormulaOp::min:
            return formula_min(a, b);
        case FormulaOp::max:
            return formula_max(a, b);
        case FormulaOp::compare:
            return a < b ? -1 : b < a ? 1 : a == b ? 0 : a + b;
        case FormulaOp::less:
            return a < b ? 1 : 0;
        case FormulaOp::less_equal:
            return a <= b ? 1 : 0;
        case FormulaOp::equal:
            return a == b ? 1 : 0;
        case FormulaOp::logic_and:
            return a == 0 ? a : b;
        default:
            return a != 0 ? a : b;
    }
}

}  // namespace lamella
