// Numbers come out rounded, short, and without exponent or minus zero.
#include "engine/base/number_format.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "engine/base/error.h"

namespace number_format_test {

using namespace lamella;

TEST_CASE("numbers keep no needless digits", "[number_format]") {
    CHECK(format_number(0, 3) == "0");
    CHECK(format_number(12, 3) == "12");
    CHECK(format_number(-0.5, 3) == "-0.5");
    CHECK(format_number(100, 0) == "100");
    CHECK(format_number(0.001, 3) == "0.001");
    CHECK(format_number(1.0005, 2) == "1");
    CHECK(format_number(999.9996, 3) == "1000");
    CHECK(format_number(0.49999999999999994, 0) == "0");
    CHECK(format_number(2.5, 0) == "3");
    CHECK(format_number(-2.5, 0) == "-3");
    CHECK(format_number(1e-7, 9) == "0.0000001");
    CHECK(format_number(1e9, 9) == "1000000000");
}

TEST_CASE("what rounds to zero has no sign", "[number_format]") {
    CHECK(format_number(-0.0, 3) == "0");
    CHECK(format_number(-0.0004, 3) == "0");
    CHECK(format_number(-0.0005, 3) == "-0.001");
}

TEST_CASE("numbers that cannot be written are refused", "[number_format]") {
    CHECK_THROWS_AS(format_number(std::numeric_limits<double>::quiet_NaN(), 3), FaultError);
    CHECK_THROWS_AS(format_number(std::numeric_limits<double>::infinity(), 3), FaultError);
    CHECK_THROWS_AS(format_number(1.1e9, 3), FaultError);
    CHECK_THROWS_AS(format_number(1, 10), FaultError);
}

TEST_CASE("numbers read back within half a unit of the last place", "[number_format]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1e4, 1e4);
    for (int i = 0; i < 20000; ++i) {
        const double v = value(random);
        const int decimals = i % 7;
        const std::string text = format_number(v, decimals);
        INFO(text);
        CHECK(std::abs(std::stod(text) - v) <= 0.5000001 * std::pow(10, -decimals));
    }
}

}  // namespace number_format_test
