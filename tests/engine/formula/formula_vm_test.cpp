// `.vm` text: what is read from it, and what is said about mistakes.
#include "engine/formula/formula_vm.h"

#include <catch2/catch.hpp>
#include <string>

#include "engine/base/error.h"

namespace formula_vm_test {

using namespace lamella;

namespace {

double value(const std::string& text, double x, double y, double z) {
    const double at[3] = {x, y, z};
    return read_vm(text, "t.vm").at(at);
}

std::string complaint(const std::string& text) {
    try {
        read_vm(text, "t.vm");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a circle is read from its text") {
    const std::string text =
        "# a circle\n_0 var-x\n_1 square _0\n_2 var-y\r\n_3 square _2\n\n_4 add _1 _3\n_5 sqrt _4\n_6 const "
        "1\n_7 sub "
        "_5 _6";
    REQUIRE(value(text, 3, 4, 0) == 4);
    REQUIRE(read_vm(text, "t.vm").size() == 5);
    REQUIRE(value("\xef\xbb\xbf" + text, 3, 4, 0) == 4);
}

TEST_CASE("every operation means what it says") {
    const auto binary = [](const std::string& op, double x, double y) {
        return value("a var-x\nb var-y\nc " + op + " a b\n", x, y, 0);
    };
    const auto unary = [](const std::string& op, double x) {
        return value("a var-x\nc " + op + " a\n", x, 0, 0);
    };
    REQUIRE(binary("add", 3, 4) == 7);
    REQUIRE(binary("sub", 3, 4) == -1);
    REQUIRE(binary("mul", 3, 4) == 12);
    REQUIRE(binary("div", 3, 4) == 0.75);
    REQUIRE(binary("mod", -1, 4) == 3);
    REQUIRE(binary("min", 3, 4) == 3);
    REQUIRE(binary("max", 3, 4) == 4);
    REQUIRE(binary("compare", 3, 4) == -1);
    REQUIRE(binary("compare", 4, 4) == 0);
    REQUIRE(binary("and", 0, 4) == 0);
    REQUIRE(binary("and", 3, 4) == 4);
    REQUIRE(binary("or", 0, 4) == 4);
    REQUIRE(binary("or", 3, 4) == 3);
    REQUIRE(binary("atan2", 1, 0) == Approx(std::acos(0.0)));
    REQUIRE(binary("pow", 2, 5) == 32);
    REQUIRE(unary("neg", 3) == -3);
    REQUIRE(unary("abs", -3) == 3);
    REQUIRE(unary("recip", 4) == 0.25);
    REQUIRE(unary("floor", -1.5) == -2);
    REQUIRE(unary("ceil", -1.5) == -1);
    REQUIRE(unary("round", -1.5) == -2);
    REQUIRE(unary("not", 0) == 1);
    REQUIRE(unary("not", 5) == 0);
    REQUIRE(unary("sin", 1) == Approx(std::sin(1.0)));
    REQUIRE(unary("cos", 1) == Approx(std::cos(1.0)));
    REQUIRE(unary("tan", 1) == Approx(std::tan(1.0)));
    REQUIRE(unary("asin", 0.3) == Approx(std::asin(0.3)));
    REQUIRE(unary("acos", 0.3) == Approx(std::acos(0.3)));
    REQUIRE(unary("atan", 0.3) == Approx(std::atan(0.3)));
    REQUIRE(unary("exp", 0.3) == Approx(std::exp(0.3)));
    REQUIRE(unary("ln", 0.3) == Approx(std::log(0.3)));
    REQUIRE(value("a var-z\nb const -1.5e0\nc mul a b", 0, 0, 2) == -3);
}

TEST_CASE("mistakes are named with their line") {
    REQUIRE(complaint("") == "t.vm: there is no operation in it");
    REQUIRE(complaint("# nothing\n\n") == "t.vm: there is no operation in it");
    REQUIRE(complaint("a var-x\nb square c\n") == "t.vm:2: no line above has the label `c`");
    REQUIRE(complaint("a var-x\nb sqare a\n") == "t.vm:2: unknown operation `sqare`");
    REQUIRE(complaint("a var-x\nb add a\n") == "t.vm:2: `add` takes 2 arguments, got 1");
    REQUIRE(complaint("a var-x\na square a\n") == "t.vm:2: the label `a` is taken");
    REQUIRE(complaint("a const 1x\n") == "t.vm:1: expected a number, found `1x`");
    REQUIRE(complaint("a const\n") == "t.vm:1: `const` takes 1 argument, got 0");
    REQUIRE(complaint("a\n") == "t.vm:1: expected `_label operation arguments`, found `a` alone");
    REQUIRE(complaint("a b\x01\n") == "t.vm:1: unknown operation `b?`");
}

}  // namespace formula_vm_test
