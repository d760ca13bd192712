// Own transcendental functions against the C library in long double.
#include "engine/base/deterministic_math.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "engine/base/simd_target.h"

namespace deterministic_math_test {

using namespace lamella;

namespace {

using Own = double (*)(double);
using Reference = long double (*)(long double);

/// The greatest error over random arguments, relative where `relative`.
double worst(Own own, Reference reference, double lo, double hi, bool relative, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> at(lo, hi);
    long double most = 0;
    for (int k = 0; k < 200'000; ++k) {
        const double x = at(random);
        const long double exact = reference(x);
        const long double error = std::fabs(static_cast<long double>(own(x)) - exact);
        most = std::max(most, relative && exact != 0 ? error / std::fabs(exact) : error);
    }
    return static_cast<double>(most);
}

constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("sine and cosine are accurate over many periods") {
    for (const double reach : {1.0, 10.0, 1000.0, 1e5}) {
        INFO("|x| < " << reach);
        REQUIRE(worst(
                    sine, [](long double x) { return std::sin(x); }, -reach, reach, false, 1) < 2e-15);
        REQUIRE(worst(
                    cosine, [](long double x) { return std::cos(x); }, -reach, reach, false, 2) < 2e-15);
    }
    std::mt19937 random(41);
    std::uniform_real_distribution<double> at(-100, 100);
    for (int k = 0; k < 1000; ++k) {
        const double x = at(random);
        REQUIRE(sine_cosine(x).sine == sine(x));
        REQUIRE(sine_cosine(x).cosine == cosine(x));
    }
    REQUIRE(std::isnan(sine_cosine(INFINITY).sine));
    REQUIRE(std::isnan(sine_cosine(NAN).cosine));
    REQUIRE(std::isnan(cosine(1e15)));
}

TEST_CASE("the tangent is accurate") {
    REQUIRE(worst(
                tangent, [](long double x) { return std::tan(x); }, 1e-4, 1.57, true, 3) < 1e-14);
    REQUIRE(worst(
                tangent, [](long double x) { return std::tan(x); }, -1.57, -1e-4, true, 4) < 1e-14);
    REQUIRE(std::isnan(tangent(1e16)));
}

TEST_CASE("exponentials and logarithms are accurate over the whole range") {
    REQUIRE(worst(
                exponential, [](long double x) { return std::exp(x); }, -1, 1, true, 5) < 4e-16);
    REQUIRE(worst(
                exponential, [](long double x) { return std::exp(x); }, -708, 709, true, 6) < 4e-16);
    REQUIRE(worst(
                exponential, [](long double x) { return std::exp(x); }, -750, -700, false, 7) < 1e-315);
    REQUIRE(exponential(0) == 1);
    REQUIRE(exponential(710) == inf);
    REQUIRE(exponential(inf) == inf);
    REQUIRE(exponential(-746) == 0);
    REQUIRE(exponential(-inf) == 0);
    REQUIRE(std::isnan(exponential(NAN)));
    REQUIRE(worst(
                logarithm, [](long double x) { return std::log(x); }, 0, 4, true, 8) < 4e-16);
    REQUIRE(worst(
                logarithm, [](long double x) { return std::log(x); }, 0.9, 1.1, true, 9) < 4e-16);
    REQUIRE(worst(
                logarithm, [](long double x) { return std::log(x); }, 1, 1e300, true, 10) < 4e-16);
    REQUIRE(worst(
                logarithm, [](long double x) { return std::log(x); }, 0, 1e-308, true, 11) < 4e-16);
    REQUIRE(logarithm(1) == 0);
    REQUIRE(logarithm(0) == -inf);
    REQUIRE(logarithm(-0.0) == -inf);
    REQUIRE(logarithm(inf) == inf);
    REQUIRE(logarithm(5e-324) == Approx(-744.4400719213812).epsilon(1e-15));
    REQUIRE(std::isnan(logarithm(-1)));
    REQUIRE(std::isnan(logarithm(NAN)));
}

TEST_CASE("inverse circular functions are accurate") {
    REQUIRE(worst(
                arctangent, [](long double x) { return std::atan(x); }, -1.5, 1.5, true, 12) < 4e-16);
    REQUIRE(worst(
                arctangent, [](long double x) { return std::atan(x); }, -1e4, 1e4, true, 13) < 4e-16);
    REQUIRE(worst(
                arcsine, [](long double x) { return std::asin(x); }, -1, 1, false, 14) < 1e-15);
    REQUIRE(worst(
                arccosine, [](long double x) { return std::acos(x); }, -1, 1, false, 15) < 1e-15);
    REQUIRE(arctangent(inf) == std::atan(inf));
    REQUIRE(arctangent(-inf) == std::atan(-inf));
    REQUIRE(std::signbit(arctangent(-0.0)));
    REQUIRE(arcsine(1) == std::asin(1.0));
    REQUIRE(arcsine(-1) == std::asin(-1.0));
    REQUIRE(arccosine(-1) == std::acos(-1.0));
    REQUIRE(arccosine(1) == 0);
    REQUIRE(std::isnan(arcsine(1.0000001)));
    REQUIRE(std::isnan(arccosine(-2)));
}

TEST_CASE("the angle of a point is accurate in every quadrant") {
    std::mt19937_64 random(16);
    std::uniform_real_distribution<double> at(-3, 3);
    for (int k = 0; k < 200'000; ++k) {
        const double y = at(random), x = at(random);
        INFO(y << ", " << x);
        const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        REQUIRE(std::fabs(static_cast<double>(arctangent2(y, x) - exact)) < 1e-15);
    }
    const double pi = std::acos(-1.0);
    REQUIRE(arctangent2(0, 0) == 0);
    REQUIRE(arctangent2(0, -1) == pi);
    REQUIRE(arctangent2(-0.0, -1) == pi);
    REQUIRE(arctangent2(1, 0) == pi / 2);
    REQUIRE(arctangent2(-1, 0) == -pi / 2);
    REQUIRE(arctangent2(inf, inf) == pi / 4);
    REQUIRE(arctangent2(1, -inf) == pi);
    REQUIRE(std::isnan(arctangent2(NAN, 1)));
    REQUIRE(std::isnan(arctangent2(1, NAN)));
}

TEST_CASE("small whole powers are multiplied out, others come from exp and ln") {
    REQUIRE(power(3, 5) == 243);
    REQUIRE(power(-3, 3) == -27);
    REQUIRE(power(2, 62) == 0x1p62);
    REQUIRE(power(2, -3) == 0.125);
    REQUIRE(power(7, 0) == 1);
    REQUIRE(power(0, 0.5) == 0);
    REQUIRE(power(-2, 101) == Approx(-std::pow(2.0, 101)).epsilon(1e-13));
    REQUIRE(std::isnan(power(-2, 0.5)));
    REQUIRE(std::isnan(power(NAN, 0)));
    std::mt19937_64 random(18);
    std::uniform_real_distribution<double> base(0.01, 20), exponent(-70, 70);
    for (int k = 0; k < 200'000; ++k) {
        const double x = base(random), y = exponent(random);
        const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
        const double error = static_cast<double>(std::fabs(power(x, y) - exact) / exact);
        REQUIRE(error < 4e-16 * (2 + std::fabs(y * std::log(x))));
    }
}

TEST_CASE("sines and cosines of many angles are those of one, to the bit, on every target",
          "[deterministic_math]") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> exponent(-20, 18), sign(-1, 1);
    std::vector<double> angles{0, -0.0, inf, -inf, std::numeric_limits<double>::quiet_NaN()};
    // No multiple of any number of lanes.
    while (angles.size() < 100'003) angles.push_back(std::pow(10.0, exponent(random)) * sign(random));
    const auto same = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
               (std::isnan(a) && std::isnan(b));
    };
    for (const std::string& target : simd_targets()) {
        INFO(target);
        force_simd_target(target);
        std::vector<SineCosine> found(angles.size());
        sines_cosines(angles, found);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const SineCosine one = sine_cosine(angles[i]);
            differ += same(one.sine, found[i].sine) && same(one.cosine, found[i].cosine) ? 0 : 1;
        }
        CHECK(differ == 0);
    }
    force_simd_target("");
    sines_cosines({}, {});
}

}  // namespace deterministic_math_test
