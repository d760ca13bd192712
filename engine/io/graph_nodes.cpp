// Table of node kinds. Names are those of the implicit extension 1.0; drafts called the arc functions arcsin
// to arctan2, and some elements differ between the specification's text and its schema.
#include "engine/io/graph_nodes.h"

#include <algorithm>
#include <map>

namespace lamella {
namespace {

using Builder = FormulaBuilder;
using Node = FormulaBuilder::Node;
using Op = FormulaOp;
using Values = std::vector<GraphValue>;
using Inputs = std::span<const GraphValue>;

constexpr std::string_view numbers = "svm";  // every type that has components
constexpr std::string_view no_matrix = "sv";

Node add(Builder& f, Node a, Node b) { return f.binary(Op::add, a, b); }
Node subtract(Builder& f, Node a, Node b) { return f.binary(Op::sub, a, b); }
Node multiply(Builder& f, Node a, Node b) { return f.binary(Op::mul, a, b); }

GraphValue scalar(Node node) {
    GraphValue value;
    value.parts[0] = node;
    return value;
}

GraphValue vector(Node x, Node y, Node z) {
    GraphValue value{GraphType::vector};
    value.parts[0] = x;
    value.parts[1] = y;
    value.parts[2] = z;
    return value;
}

/// Applies op(builder, arguments) to each component of inputs of one type.
template <Node (*op)(Builder&, const Node*)>
Values each(Builder& builder, const GraphNode& /*node*/, Inputs inputs) {
    GraphValue out{inputs[0].type};
    for (std::size_t c = 0; c < components(out.type); ++c) {
        std::array<Node, 4> arguments{};
        for (std::size_t i = 0; i < inputs.size(); ++i) arguments[i] = inputs[i].parts[c];
        out.parts[c] = op(builder, arguments.data());
    }
    return {out};
}

template <FormulaOp op>
Node one(Builder& f, const Node* a) {
    return f.unary(op, a[0]);
}
template <FormulaOp op>
Node two(Builder& f, const Node* a) {
    return f.binary(op, a[0], a[1]);
}

/// Remainder with the dividend's sign.
Node fmod_of(Builder& f, const Node* a) {
    const Node rest = f.binary(Op::mod, f.unary(Op::abs, a[0]), f.unary(Op::abs, a[1]));
    return multiply(f, f.binary(Op::compare, a[0], f.constant(0)), rest);
}

/// a - b floor(a / b), with the divisor's sign. Uses the remainder operation, whose ranges are tight, if that
/// sign is known.
Node mod_of(Builder& f, const Node* a) {
    const auto divisor = f.number_of(a[1]);
    if (divisor && *divisor > 0) return f.binary(Op::mod, a[0], a[1]);
    if (divisor && *divisor < 0)
        return f.unary(Op::neg, f.binary(Op::mod, f.unary(Op::neg, a[0]), f.constant(-*divisor)));
    const Node quotient = f.unary(Op::floor, f.binary(Op::div, a[0], a[1]));
    return subtract(f, a[0], multiply(f, a[1], quotient));
}

Node fract_of(Builder& f, const Node* a) { return f.binary(Op::mod, a[0], f.constant(1)); }
Node sign_of(Builder& f, const Node* a) { return f.binary(Op::compare, a[0], f.constant(0)); }

Node log2_of(Builder& f, const Node* a) {
    constexpr double ln2 = 0.693147180559945309417;
    return f.binary(Op::div, f.unary(Op::ln, a[0]), f.constant(ln2));
}
Node log10_of(Builder& f, const Node* a) {
    constexpr double ln10 = 2.302585092994045684;
    return f.binary(Op::div, f.unary(Op::ln, a[0]), f.constant(ln10));
}

/// (e^a + sign e^-a) / 2
Node half_exponentials(Builder& f, Node a, Op join) {
    const Node rising = f.unary(Op::exp, a), falling = f.unary(Op::exp, f.unary(Op::neg, a));
    return multiply(f, f.constant(0.5), f.binary(join, rising, falling));
}
Node cosh_of(Builder& f, const Node* a) { return half_exponentials(f, f.unary(Op::abs, a[0]), Op::add); }
Node sinh_of(Builder& f, const Node* a) { return half_exponentials(f, a[0], Op::sub); }
/// 1 - 2 / (e^2a + 1), which has the correct limits when the exponential overflows.
Node tanh_of(Builder& f, const Node* a) {
    const Node growth = f.unary(Op::exp, multiply(f, f.constant(2), a[0]));
    return subtract(f, f.constant(1), f.binary(Op::div, f.constant(2), add(f, growth, f.constant(1))));
}

Node select_of(Builder& f, const Node* a) { return f.select(f.binary(Op::less, a[0], a[1]), a[2], a[3]); }
Node clamp_of(Builder& f, const Node* a) { return f.binary(Op::max, a[1], f.binary(Op::min, a[0], a[2])); }

Node dot_of(Builder& f, const GraphValue& a, const GraphValue& b) {
    Node sum = multiply(f, a.parts[0], b.parts[0]);
    for (std::size_t i = 1; i < 3; ++i) sum = add(f, sum, multiply(f, a.parts[i], b.parts[i]));
    return sum;
}

Values constant(Builder& builder, const GraphNode& node, Inputs /*inputs*/) {
    constexpr std::array types{GraphType::scalar, GraphType::vector, GraphType::matrix};
    for (const GraphType type : types) {
        if (components(type) != node.numbers.size()) continue;
        GraphValue value{type};
        for (std::size_t i = 0; i < node.numbers.size(); ++i)
            value.parts[i] = builder.constant(node.numbers[i]);
        return {value};
    }
    return {};
}

Values compose(Builder& /*builder*/, const GraphNode& /*node*/, Inputs inputs) {
    GraphValue value{inputs.size() == 3 ? GraphType::vector : GraphType::matrix};
    for (std::size_t i = 0; i < inputs.size(); ++i) value.parts[i] = inputs[i].parts[0];
    return {value};
}

Values decompose(Builder& /*builder*/, const GraphNode& /*node*/, Inputs inputs) {
    const auto& parts = inputs[0].parts;
    return {scalar(parts[0]), scalar(parts[1]), scalar(parts[2])};
}

Values repeat(Builder& /*builder*/, const GraphNode& /*node*/, Inputs inputs) {
    const Node a = inputs[0].parts[0];
    return {vector(a, a, a)};
}

/// Makes a matrix of four vectors: as columns, with a last row 0 0 0 1, or as rows, with a last column 0 0 0
/// 1.
template <bool columns>
Values matrix_of_vectors(Builder& builder, const GraphNode& /*node*/, Inputs inputs) {
    GraphValue value{GraphType::matrix};
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            const Node entry = j < 3 ? inputs[i].parts[j] : builder.constant(i == 3 ? 1 : 0);
            value.parts[columns ? 4 * j + i : 4 * i + j] = entry;
        }
    }
    return {value};
}

Values dot(Builder& builder, const GraphNode& /*node*/, Inputs inputs) {
    return {scalar(dot_of(builder, inputs[0], inputs[1]))};
}

Values length(Builder& builder, const GraphNode& /*node*/, Inputs inputs) {
    return {scalar(builder.unary(Op::sqrt, dot_of(builder, inputs[0], inputs[0])))};
}

Values cross(Builder& f, const GraphNode& /*node*/, Inputs inputs) {
    const auto& a = inputs[0].parts;
    const auto& b = inputs[1].parts;
    const auto minor = [&](std::size_t i, std::size_t j) {
        return subtract(f, multiply(f, a[i], b[j]), multiply(f, a[j], b[i]));
    };
    return {vector(minor(1, 2), minor(2, 0), minor(0, 1))};
}

/// A (x, y, z, 1) without its last component.
Values transform(Builder& f, const GraphNode& /*node*/, Inputs inputs) {
    GraphValue out{GraphType::vector};
    for (std::size_t row = 0; row < 3; ++row) {
        const Node* m = &inputs[0].parts[4 * row];
        Node sum = multiply(f, m[0], inputs[1].parts[0]);
        for (std::size_t i = 1; i < 3; ++i) sum = add(f, sum, multiply(f, m[i], inputs[1].parts[i]));
        out.parts[row] = add(f, sum, m[3]);
    }
    return {out};
}

Values transpose(Builder& /*builder*/, const GraphNode& /*node*/, Inputs inputs) {
    GraphValue out{GraphType::matrix};
    for (std::size_t i = 0; i < 16; ++i) out.parts[i] = inputs[0].parts[4 * (i % 4) + i / 4];
    return {out};
}

/// Inverse by cofactors: each consists of the 2 x 2 determinants of the two rows or columns that it omits.
Values inverse(Builder& f, const GraphNode& /*node*/, Inputs inputs) {
    const auto at = [&](std::size_t row, std::size_t column) { return inputs[0].parts[4 * row + column]; };
    const auto cofactor = [&](std::size_t row, std::size_t column) {
        std::array<std::size_t, 3> r{}, c{};
        for (std::size_t i = 0, n = 0; i < 4; ++i) {
            if (i != row) r[n++] = i;
        }
        for (std::size_t i = 0, n = 0; i < 4; ++i) {
            if (i != column) c[n++] = i;
        }
        const auto minor = [&](std::size_t i, std::size_t j) {
            return subtract(f, multiply(f, at(r[1], c[i]), at(r[2], c[j])),
                            multiply(f, at(r[1], c[j]), at(r[2], c[i])));
        };
        Node sum = multiply(f, at(r[0], c[0]), minor(1, 2));
        sum = subtract(f, sum, multiply(f, at(r[0], c[1]), minor(0, 2)));
        sum = add(f, sum, multiply(f, at(r[0], c[2]), minor(0, 1)));
        return (row + column) % 2 == 0 ? sum : f.unary(Op::neg, sum);
    };
    GraphValue out{GraphType::matrix};
    Node determinant = -1;
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 4; ++row) out.parts[4 * column + row] = cofactor(row, column);
        const Node term = multiply(f, at(0, column), out.parts[4 * column]);
        determinant = determinant < 0 ? term : add(f, determinant, term);
    }
    for (Node& part : out.parts) part = f.binary(Op::div, part, determinant);
    return {out};
}

using Ports = std::vector<NodePort>;

/// Returns a kind whose result and inputs A, B, ... have one type.
NodeKind alike(std::string_view name, std::string_view types, Ports inputs, decltype(NodeKind::make) make) {
    for (NodePort& input : inputs) input.types = types;
    return {name, std::move(inputs), {{"result", types}}, make};
}

Ports matrix_entries() {
    constexpr std::array<std::string_view, 16> names{"m00", "m01", "m02", "m03", "m10", "m11", "m12", "m13",
                                                     "m20", "m21", "m22", "m23", "m30", "m31", "m32", "m33"};
    Ports ports;
    for (const std::string_view name : names) ports.push_back({name, "s"});
    return ports;
}

std::map<std::string_view, NodeKind> make_table() {
    const Ports a{{"A", ""}}, ab{{"A", ""}, {"B", ""}}, abcd{{"A", ""}, {"B", ""}, {"C", ""}, {"D", ""}};
    const Ports vectors{{"A", "v"}, {"B", "v"}, {"C", "v"}, {"D", "v"}};
    const Ports two_vectors{{"A", "v"}, {"B", "v"}}, result{{"result", "m", "matrix"}};
    const Ports at_mesh{{"pos", "v"}, {"mesh", "r"}}, distance{{"distance", "s"}};
    const std::vector<NodeKind> list{
        alike("addition", numbers, ab, each<two<Op::add>>),
        alike("subtraction", numbers, ab, each<two<Op::sub>>),
        alike("multiplication", numbers, ab, each<two<Op::mul>>),
        alike("division", numbers, ab, each<two<Op::div>>),
        alike("min", numbers, ab, each<two<Op::min>>),
        alike("max", numbers, ab, each<two<Op::max>>),
        alike("pow", numbers, ab, each<two<Op::pow>>),
        alike("fmod", numbers, ab, each<fmod_of>),
        alike("mod", numbers, ab, each<mod_of>),
        alike("atan2", no_matrix, ab, each<two<Op::atan2>>),
        alike("arctan2", no_matrix, ab, each<two<Op::atan2>>),
        alike("sin", no_matrix, a, each<one<Op::sin>>),
        alike("cos", no_matrix, a, each<one<Op::cos>>),
        alike("tan", no_matrix, a, each<one<Op::tan>>),
        alike("asin", no_matrix, a, each<one<Op::asin>>),
        alike("acos", no_matrix, a, each<one<Op::acos>>),
        alike("atan", no_matrix, a, each<one<Op::atan>>),
        alike("arcsin", no_matrix, a, each<one<Op::asin>>),
        alike("arccos", no_matrix, a, each<one<Op::acos>>),
        alike("arctan", no_matrix, a, each<one<Op::atan>>),
        alike("abs", numbers, a, each<one<Op::abs>>),
        alike("sqrt", numbers, a, each<one<Op::sqrt>>),
        alike("exp", numbers, a, each<one<Op::exp>>),
        alike("log", numbers, a, each<one<Op::ln>>),
        alike("log2", numbers, a, each<log2_of>),
        alike("log10", numbers, a, each<log10_of>),
        alike("cosh", numbers, a, each<cosh_of>),
        alike("sinh", numbers, a, each<sinh_of>),
        alike("tanh", numbers, a, each<tanh_of>),
        alike("round", numbers, a, each<one<Op::round>>),
        alike("ceil", numbers, a, each<one<Op::ceil>>),
        alike("floor", numbers, a, each<one<Op::floor>>),
        alike("sign", numbers, a, each<sign_of>),
        alike("fract", numbers, a, each<fract_of>),
        alike("select", numbers, abcd, each<select_of>),
        alike("clamp", numbers, {{"A", ""}, {"min", ""}, {"max", ""}}, each<clamp_of>),
        {"constant", {}, {{"value", "s"}}, constant},
        {"constvec", {}, {{"vector", "v"}}, constant},
        {"constmat", {}, {{"matrix", "m"}}, constant},
        {"constresourceid", {}, {{"value", "r"}}},
        {"resourceid", {}, {{"value", "r"}}},
        {"composevector", {{"x", "s"}, {"y", "s"}, {"z", "s"}}, {{"result", "v", "vector"}}, compose},
        {"vectorfromscalar", {{"A", "s"}}, {{"result", "v", "vector"}}, repeat},
        {"decomposevector", {{"A", "v"}}, {{"x", "s"}, {"y", "s"}, {"z", "s"}}, decompose},
        {"composematrix", matrix_entries(), result, compose},
        {"matrixfromcolumns", vectors, result, matrix_of_vectors<true>},
        {"matrixfromrows", vectors, result, matrix_of_vectors<false>},
        {"dot", two_vectors, {{"result", "s"}}, dot},
        {"cross", two_vectors, {{"result", "v"}}, cross},
        {"length", {{"A", "v"}}, {{"result", "s"}}, length},
        {"matvecmultiplication", {{"A", "m"}, {"B", "v"}}, {{"result", "v"}}, transform},
        {"matrixvectormultiplication", {{"A", "m"}, {"B", "v"}}, {{"result", "v"}}, transform},
        {"transpose", {{"A", "m"}}, result, transpose},
        {"inverse", {{"A", "m"}}, result, inverse},
        {"mesh", at_mesh, distance},
        {"unsignedmesh", at_mesh, distance},
        {"functioncall", {{"functionID", "r"}}, {}}};
    std::map<std::string_view, NodeKind> table;
    for (const NodeKind& kind : list) table.emplace(kind.name, kind);
    return table;
}

}  // namespace

const NodeKind* find_node_kind(std::string_view name) {
    static const std::map<std::string_view, NodeKind> table = make_table();
    const auto found = table.find(name);
    return found == table.end() ? nullptr : &found->second;
}

char letter_of(GraphType type) { return "svmr"[static_cast<std::size_t>(type)]; }

}  // namespace lamella
