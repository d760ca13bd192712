// FormulaBuilder: makes formulas from operations; equal parts are made once and constant parts worked out.
#pragma once

#include <optional>
#include <unordered_map>

#include "engine/formula/formula.h"

namespace lamella {

/// Grows a formula bottom up. Identities are used only where they keep every bit of the result.
class FormulaBuilder {
  public:
    /// A number within the formula; valid for the builder that made it.
    using Node = std::int32_t;
    /// More than this many nodes, or inputs, are an InputError.
    static constexpr int max_nodes = 4'000'000;
    static constexpr int max_inputs = 1000;

    Node input(int number);
    /// From now on the input is that number.
    void fix_input(int number, double value) { fixed_[number] = value; }
    Node constant(double value);
    Node unary(FormulaOp op, Node a);
    /// A `pow` with a small whole constant exponent becomes multiplications.
    Node binary(FormulaOp op, Node a, Node b);
    /// `yes` where the condition is not zero, else `no`.
    Node select(Node condition, Node yes, Node no);
    /// The result of a formula that is part of this one; its inputs keep their numbers.
    Node include(const Formula& formula);
    /// The number of a node that is constant.
    std::optional<double> number_of(Node node) const;
    /// The formula whose number is `result`, less what it does not use. The builder may go on.
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
