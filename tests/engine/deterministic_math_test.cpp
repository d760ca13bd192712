// Own sine and cosine against the C library.
#include "engine/deterministic_math.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

TEST_CASE("sine and cosine are accurate over many periods") {
    std::mt19937 random(41);
    std::uniform_real_distribution<double> near(-10, 10), far(-1e5, 1e5);
    for (int k = 0; k < 20000; ++k) {
        const double x = k % 2 == 0 ? near(random) : far(random);
        const auto got = lamella::sine_cosine(x);
        INFO("x " << x);
        REQUIRE(got.sine == Approx(std::sin(x)).margin(2e-15));
        REQUIRE(got.cosine == Approx(std::cos(x)).margin(2e-15));
    }
    REQUIRE(std::isnan(lamella::sine_cosine(INFINITY).sine));
    REQUIRE(std::isnan(lamella::sine_cosine(NAN).cosine));
}
