// Every kind of node against what the C library and GLM compute.
#include "engine/io/graph_nodes.h"

#include <catch2/catch.hpp>
#include <functional>
#include <glm/gtc/matrix_access.hpp>
#include <random>

namespace graph_nodes_test {

using namespace lamella;

namespace {

using Numbers = std::vector<double>;

/// The outputs of a node for inputs that are numbers, all of them side by side. Inputs are variables, so
/// that operations are not worked out when the formula is made.
Numbers outputs_of_node(const std::string& kind, const std::vector<Numbers>& inputs,
                        const Numbers& constants = {}) {
    FormulaBuilder builder;
    GraphNode node;
    node.kind = kind;
    node.numbers = constants;
    std::vector<GraphValue> values;
    Numbers numbers;
    for (const Numbers& input : inputs) {
        GraphValue value;
        value.type = input.size() == 1   ? GraphType::scalar
                     : input.size() == 3 ? GraphType::vector
                                         : GraphType::matrix;
        for (std::size_t i = 0; i < input.size(); ++i) {
            value.parts[i] = builder.input(static_cast<int>(numbers.size()));
            numbers.push_back(input[i]);
        }
        values.push_back(value);
    }
    const NodeKind* found = find_node_kind(kind);
    REQUIRE(found != nullptr);
    REQUIRE(found->make != nullptr);
    Numbers out;
    for (const GraphValue& value : found->make(builder, node, values)) {
        for (std::size_t i = 0; i < components(value.type); ++i)
            out.push_back(builder.finish(value.parts[i]).at(numbers));
    }
    return out;
}

struct Unary {
    const char* kind;
    double (*truth)(double);
    double lo, hi;
};

struct Binary {
    const char* kind;
    double (*truth)(double, double);
    double lo, hi;
};

Numbers row_wise(const glm::dmat4& m) {
    Numbers out;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) out.push_back(m[column][row]);
    }
    return out;
}

glm::dmat4 random_matrix(std::mt19937& random) {
    std::uniform_real_distribution<double> entry(-2, 2);
    glm::dmat4 m;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) m[i][j] = entry(random);
    }
    return m;
}

}  // namespace

TEST_CASE("nodes of one argument compute what the C library does, for scalars, vectors and matrices",
          "[implicit]") {
    const auto table =
        std::vector<Unary>{{"sin", std::sin, -9, 9},
                           {"cos", std::cos, -9, 9},
                           {"tan", std::tan, -1.5, 1.5},
                           {"asin", std::asin, -1, 1},
                           {"arcsin", std::asin, -1, 1},
                           {"acos", std::acos, -1, 1},
                           {"arccos", std::acos, -1, 1},
                           {"atan", std::atan, -9, 9},
                           {"arctan", std::atan, -9, 9},
                           {"abs", std::fabs, -9, 9},
                           {"sqrt", std::sqrt, 0, 9},
                           {"exp", std::exp, -9, 9},
                           {"log", std::log, 0.01, 9},
                           {"log2", std::log2, 0.01, 9},
                           {"log10", std::log10, 0.01, 9},
                           {"cosh", std::cosh, -9, 9},
                           {"sinh", std::sinh, -9, 9},
                           {"tanh", std::tanh, -9, 9},
                           {"round", std::round, -9, 9},
                           {"ceil", std::ceil, -9, 9},
                           {"floor", std::floor, -9, 9},
                           {"fract", [](double a) { return a - std::floor(a); }, -9, 9},
                           {"sign", [](double a) { return a < 0   ? -1.0
                                                          : a > 0 ? 1.0
                                                                  : 0.0; }, -9, 9}};
    std::mt19937 random(1);
    for (const Unary& entry : table) {
        CAPTURE(entry.kind);
        std::uniform_real_distribution<double> place(entry.lo, entry.hi);
        const bool matrices = find_node_kind(entry.kind)->inputs[0].types == "svm";
        for (const std::size_t size : {1, 3, 16}) {
            if (size == 16 && !matrices) continue;
            Numbers input;
            for (std::size_t i = 0; i < size; ++i) input.push_back(place(random));
            const Numbers found = outputs_of_node(entry.kind, {input});
            REQUIRE(found.size() == size);
            for (std::size_t i = 0; i < size; ++i)
                CHECK(found[i] == Approx(entry.truth(input[i])).epsilon(1e-13).margin(1e-13));
        }
    }
    // Far out, where exponentials overflow.
    CHECK(outputs_of_node("tanh", {{1000}}) == Numbers{1});
    CHECK(outputs_of_node("tanh", {{-1000}}) == Numbers{-1});
}

TEST_CASE("nodes of two arguments compute what the C library does", "[implicit]") {
    const auto table =
        std::vector<Binary>{{"addition", [](double a, double b) { return a + b; }, -9, 9},
                            {"subtraction", [](double a, double b) { return a - b; }, -9, 9},
                            {"multiplication", [](double a, double b) { return a * b; }, -9, 9},
                            {"division", [](double a, double b) { return a / b; }, -9, 9},
                            {"min", [](double a, double b) { return std::fmin(a, b); }, -9, 9},
                            {"max", [](double a, double b) { return std::fmax(a, b); }, -9, 9},
                            {"pow", [](double a, double b) { return std::pow(a, b); }, 0.1, 5},
                            {"fmod", [](double a, double b) { return std::fmod(a, b); }, -9, 9},
                            {"mod", [](double a, double b) { return a - b * std::floor(a / b); }, -9, 9},
                            {"atan2", [](double a, double b) { return std::atan2(a, b); }, -9, 9},
                            {"arctan2", [](double a, double b) { return std::atan2(a, b); }, -9, 9}};
    std::mt19937 random(2);
    for (const Binary& entry : table) {
        CAPTURE(entry.kind);
        std::uniform_real_distribution<double> place(entry.lo, entry.hi);
        for (int round = 0; round < 20; ++round) {
            Numbers a, b;
            for (int i = 0; i < 3; ++i) {
                a.push_back(place(random));
                b.push_back(place(random));
            }
            const Numbers found = outputs_of_node(entry.kind, {a, b});
            for (std::size_t i = 0; i < 3; ++i) {
                CAPTURE(a[i], b[i]);
                CHECK(found[i] == Approx(entry.truth(a[i], b[i])).epsilon(1e-13).margin(1e-13));
            }
        }
    }
}

TEST_CASE("mod by a constant is the remainder with the divisor's sign", "[implicit]") {
    for (const double divisor : {2.5, -2.5}) {
        for (const double a : {-7.1, -2.5, -0.1, 0.0, 0.1, 2.4, 2.5, 7.1}) {
            FormulaBuilder builder;
            std::vector<GraphValue> inputs(2);
            inputs[0].parts[0] = builder.input(0);
            inputs[1].parts[0] = builder.constant(divisor);
            const auto out = find_node_kind("mod")->make(builder, {}, inputs);
            const double numbers[] = {a};
            CAPTURE(a, divisor);
            CHECK(builder.finish(out[0].parts[0]).at(numbers) ==
                  Approx(a - divisor * std::floor(a / divisor)).margin(1e-14));
        }
    }
}

TEST_CASE("select and clamp work component by component", "[implicit]") {
    CHECK(outputs_of_node("select", {{1, 2, 3}, {2, 2, 2}, {10, 20, 30}, {-1, -2, -3}}) ==
          Numbers{10, -2, -3});
    CHECK(outputs_of_node("clamp", {{-1, 0.5, 7}, {0, 0, 0}, {1, 1, 1}}) == Numbers{0, 0.5, 1});
}

TEST_CASE("vectors and matrices are put together, multiplied and inverted as in linear algebra",
          "[implicit]") {
    CHECK(outputs_of_node("composevector", {{1}, {2}, {3}}) == Numbers{1, 2, 3});
    CHECK(outputs_of_node("decomposevector", {{1, 2, 3}}) == Numbers{1, 2, 3});
    CHECK(outputs_of_node("vectorfromscalar", {{4}}) == Numbers{4, 4, 4});
    CHECK(outputs_of_node("constvec", {}, {1, 2, 3}) == Numbers{1, 2, 3});
    CHECK(outputs_of_node("dot", {{1, 2, 3}, {4, -5, 6}}) == Numbers{12});
    CHECK(outputs_of_node("cross", {{1, 2, 3}, {4, -5, 6}}) == Numbers{27, 6, -13});
    CHECK(outputs_of_node("length", {{2, 3, 6}}) == Numbers{7});
    CHECK(outputs_of_node("matrixfromcolumns", {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}) ==
          Numbers{1, 4, 7, 10, 2, 5, 8, 11, 3, 6, 9, 12, 0, 0, 0, 1});
    CHECK(outputs_of_node("matrixfromrows", {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}) ==
          Numbers{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1});
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        const glm::dmat4 m = random_matrix(random);
        CHECK(outputs_of_node("transpose", {row_wise(m)}) == row_wise(glm::transpose(m)));
        const Numbers inverse = outputs_of_node("inverse", {row_wise(m)});
        const Numbers truth = row_wise(glm::inverse(m));
        for (std::size_t i = 0; i < 16; ++i) CHECK(inverse[i] == Approx(truth[i]).epsilon(1e-9).margin(1e-9));
        const glm::dvec4 image = m * glm::dvec4(1.5, -2, 3, 1);
        const Numbers product = outputs_of_node("matvecmultiplication", {row_wise(m), {1.5, -2, 3}});
        for (int i = 0; i < 3; ++i)
            CHECK(product[static_cast<std::size_t>(i)] == Approx(image[i]).margin(1e-13));
    }
}

TEST_CASE("whether a number is NaN is known of intervals that cannot be", "[implicit]") {
    FormulaBuilder builder;
    const auto x = builder.input(0);
    const auto root = builder.unary(FormulaOp::sqrt, x);
    const auto known =
        builder.select(builder.binary(FormulaOp::equal, root, root), root, builder.constant(-1));
    const Formula formula = builder.finish(known);
    const FormulaRange positive[] = {{{4, 9}, false}}, any[] = {{{-4, 9}, false}},
                       negative[] = {{{-9, -4}, false}};
    CHECK(range(formula, positive).values.lo == 2);
    CHECK(range(formula, positive).values.hi == 3);
    CHECK(range(formula, any).values.lo == -1);
    CHECK(range(formula, negative).values.hi == -1);
    const double below[] = {-4.0};
    CHECK(formula.at(below) == -1);
}

}  // namespace graph_nodes_test
