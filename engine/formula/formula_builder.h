// FormulaBuilder: makes formulas from operations, sharing equal subexpressions and folding constants.
#pragma once

#include <optional>
#include <unordered_map>

#include "engine/formula/formula.h"

namespace lamella {

/// Builds a formula bottom up. Applies algebraic identities only where they keep every bit of the result.
class FormulaBuilder {
  public:
    /// A value within the formula; valid for the builder that made it.
    using Node = std::int32_t;
    /// Limits: exceeding either throws InputError.
    static constexpr int max_nodes = 4'000'000;
    static constexpr int max_inputs = 1000;

    Node input(int number);
    /// Replaces the input by a constant in everything built from now on.
    void fix_input(int number, double value) { fixed_[number] = value; }
    Node constant(double value);
    Node unary(FormulaOp op, Node a);
    /// Appends an operation of two arguments. A `pow` with a small whole constant exponent becomes
    /// multiplications.
    Node binary(FormulaOp op, Node a, Node b);
    /// Appends a choice: `yes` where the condition is not zero, else `no`.
    Node select(Node condition, Node yes, Node no);
    /// Appends a whole formula and returns its result; its inputs keep their numbers.
    Node include(const Formula& formula);
    /// Returns the number of a node that is constant.
    std::optional<double> number_of(Node node) const;
    /// Returns the formula that computes `result`, without unused nodes. The builder can go on.
    Formula finish(Node result) const;

  private:
    struct Key {
        FormulaOp op;
        std::uint64_t a, b, c;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const;
    };
    Node add(FormulaOp op, std::uint64_t a, std::uint64_t b, std::uint64_t c);
    Node whole_power(Node base, int exponent);
    const double* value_of(Node node) const;

    std::vector<FormulaInstruction> nodes_;
    std::vector<double> constants_;
    std::unordered_map<Key, Node, KeyHash> known_;
    std::unordered_map<int, double> fixed_;
};

}  // namespace lamella
