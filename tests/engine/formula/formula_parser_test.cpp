// The language of formulas: what it means, and what is said when it means nothing.
#include "engine/formula/formula_parser.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

namespace formula_parser_test {

using namespace lamella;

namespace {

const std::vector<std::string> names{"x", "y", "z", "depth"};

double value(const std::string& text, std::vector<double> inputs = {2, 3, 5, 7}) {
    return parse_formula(text, names).at(inputs);
}

std::string complaint(const std::string& text) {
    try {
        parse_formula(text, names);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("operators bind as in mathematics") {
    REQUIRE(value("1 + 2 * 3") == 7);
    REQUIRE(value("(1 + 2) * 3") == 9);
    REQUIRE(value("2 ^ 3 ^ 2") == 512);
    REQUIRE(value("-x ^ 2") == -4);
    REQUIRE(value("2 ^ -1") == 0.5);
    REQUIRE(value("10 - 4 - 3") == 3);
    REQUIRE(value("64 / 4 / 2") == 8);
    REQUIRE(value("7 % 4") == 3);
    REQUIRE(value("-1 % 4") == 3);
    REQUIRE(value("--x + +y") == 5);
    REQUIRE(value("1.5e1 + .5") == 15.5);
    REQUIRE(value("x + 1 < y * 2 and z > 4") == 1);
    REQUIRE(value("not x > y") == 1);
    REQUIRE(value("!x + 1") == 1);
    REQUIRE(value("x > y or z == 5") == 1);
    REQUIRE(value("x != 2 || y >= 3 && z <= 4") == 0);
    REQUIRE(value("x < y ? 10 : 20") == 10);
    REQUIRE(value("x > y ? 10 : z > y ? 30 : 40") == 30);
    REQUIRE(value("0 / 0 != 0 / 0") == 1);
    REQUIRE(value("depth * 2") == 14);
    REQUIRE(value(" x\n+\ty ") == 5);
}

TEST_CASE("functions compute what their names say") {
    REQUIRE(value("sqrt(16) + abs(-2) + square(3)") == 15);
    REQUIRE(value("min(x, y, z) + max(x, y, z)") == 7);
    REQUIRE(value("hypot(3, 4) + length(2, 3, 6)") == 12);
    REQUIRE(value("clamp(9, 0, 1) + clamp(-9, 0, 1) + clamp(0.25, 0, 1)") == 1.25);
    REQUIRE(value("mix(10, 20, 1.5)") == 25);
    REQUIRE(value("blend(10, 20, 1.5) + blend(10, 20, 0.5)") == 35);
    REQUIRE(value("step(2, x) + step(2.5, x)") == 1);
    REQUIRE(value("smoothstep(0, 4, x)") == 0.5);
    REQUIRE(value("smoothstep(3, 4, x) + smoothstep(0, 1, x)") == 1);
    REQUIRE(value("floor(-1.5) + ceil(1.2) + round(2.5) + round(-2.5)") == 0);
    REQUIRE(value("sign(-3) + sign(0) + 2 * sign(9)") == 1);
    REQUIRE(value("mod(-7, 3)") == 2);
    REQUIRE(value("pow(2, 10) + pow(4, 0.5)") == Approx(1026).epsilon(1e-15));
    REQUIRE(value("sin(pi / 6) + cos(tau / 2)") == Approx(-0.5).margin(1e-15));
    REQUIRE(value("tan(1) + asin(0.5) + acos(0.5) + atan(2) + atan2(1, -1)") ==
            Approx(std::tan(1.0) + std::asin(0.5) + std::acos(0.5) + std::atan(2.0) + std::atan2(1.0, -1.0)));
    REQUIRE(value("ln(e) + log(e ^ 2) + log10(1000) + exp(0)") == Approx(7).epsilon(1e-14));
}

TEST_CASE("names come in the order of their first use, and hide constants when given") {
    REQUIRE(formula_names("b + sin(a) * b - pi + e * d.x_1") == std::vector<std::string>{"b", "a", "d.x_1"});
    REQUIRE(formula_names("1 + tau").empty());
    const std::vector<std::string> own{"e"};
    const double at[1] = {3};
    REQUIRE(parse_formula("e * 2", own).at(at) == 6);
}

TEST_CASE("a mistake is named with its column and a way out") {
    REQUIRE(complaint("x + y * q") == "column 9: unknown name `q`; known: x, y, z, depth");
    REQUIRE(complaint("x + dept") ==
            "column 5: unknown name `dept`, did you mean `depth`?; known: x, y, z, depth");
    REQUIRE(complaint("sqr(x)") == "column 1: unknown function `sqr`, did you mean `sqrt`?");
    REQUIRE(complaint("min(x)") == "column 1: `min` takes 2 or more arguments, got 1");
    REQUIRE(complaint("clamp(x, 1)") == "column 1: `clamp` takes 3 arguments, got 2");
    REQUIRE(complaint("sin()") == "column 1: `sin` takes 1 argument, got 0");
    REQUIRE(complaint("x + sin") == "column 5: `sin` is a function: write `sin(...)`");
    REQUIRE(complaint("") == "column 1: the formula is empty");
    REQUIRE(complaint("x +") == "column 4: expected a number, a name or `(`, found the end");
    REQUIRE(complaint("(x + 1") == "column 7: expected `)`, found the end");
    REQUIRE(complaint("x y") == "column 3: expected an operator or the end of the formula, found `y`");
    REQUIRE(complaint("2x") == "column 2: a number ends here: write `2*x`, not `2x`");
    REQUIRE(complaint("1 < x < 3") ==
            "column 7: comparisons do not chain: write `a < b and b < c` instead of `a < b < c`");
    REQUIRE(complaint("x ? 1") == "column 6: expected `:`, found the end");
    REQUIRE(complaint("x $ 2") == "column 3: expected an operator or the end of the formula, found `$`");
    REQUIRE(complaint("1e999") == "column 1: the number is out of range");
    REQUIRE(complaint("x + \xff") ==
            "column 5: expected a number, a name or `(`, found a character that has no meaning here");
    REQUIRE_THROWS_AS(formula_names("min(1,"), InputError);
}

TEST_CASE("hostile text is refused without falling over") {
    for (const char* part : {"(", "-", "!", "not ", "sin(", "1?", "1?1:", "2^", "min(1,", "1-(", "x^("}) {
        INFO(part);
        std::string text;
        while (text.size() < 500'000) text += part;
        REQUIRE_THROWS_AS(formula_names(text), InputError);
        REQUIRE(complaint(text + "1").find("nested more than 200 deep") != std::string::npos);
    }
    REQUIRE_THROWS_AS(formula_names(std::string((1 << 20) + 1, ' ')), InputError);
    REQUIRE_THROWS_AS(formula_names(std::string_view("\0", 1)), InputError);
    std::string many = "v0";
    for (int i = 1; i < 2000; ++i) many += "+v" + std::to_string(i);
    REQUIRE_THROWS_AS(formula_names(many), InputError);
    std::string deep(100, '(');
    REQUIRE(value(deep + "x" + std::string(100, ')')) == 2);
    std::string sum = "x";
    for (int i = 0; i < 100'000; ++i) sum += "+y";
    REQUIRE(value(sum) == 300'002);
}

}  // namespace formula_parser_test
