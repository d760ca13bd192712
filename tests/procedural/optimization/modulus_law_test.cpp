// Moduli and their slopes against formulas, laws of foams and differences.
#include "procedural/optimization/modulus_law.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"

namespace modulus_law_test {

using namespace lamella;

namespace {

std::vector<FoamLawTable> shipped_laws() {
    std::ifstream file(LAMELLA_SOURCE_DIR "/materials/foam_laws.csv");
    std::stringstream text;
    text << file.rdbuf();
    return read_foam_laws(text.str(), "foam_laws.csv");
}

/// Compares the slope with a central difference.
void check_slope(const ModulusLaw& law, double density) {
    CAPTURE(density);
    const double h = 1e-4 * density;
    const double difference = (law.modulus(density + h) - law.modulus(density - h)) / (2 * h);
    CHECK(law.slope(density) == Approx(difference).epsilon(1e-6));
}

}  // namespace

TEST_CASE("a penalised modulus is the least one plus a power of the density", "[optimization]") {
    for (const double exponent : {1.0, 2.0, 3.0, 4.5}) {
        const auto law = make_penalty_law({.exponent = exponent, .least = 1e-3});
        CHECK(law->modulus(0) == 1e-3);
        CHECK(law->modulus(1) == Approx(1).epsilon(1e-15));
        for (const double density : {0.01, 0.3, 0.5, 0.999}) {
            CHECK(law->modulus(density) ==
                  Approx(1e-3 + std::pow(density, exponent) * (1 - 1e-3)).epsilon(1e-13));
            check_slope(*law, density);
        }
    }
}

TEST_CASE("a penalised modulus is linear below the density asked for", "[optimization]") {
    const auto law = make_penalty_law({.exponent = 3, .least = 0, .linear_to = 0.3});
    CHECK(law->modulus(0) == 0);
    CHECK(law->slope(0) == Approx(0.09).epsilon(1e-14));
    CHECK(law->modulus(0.1) == Approx(0.1 * 0.3 * 0.3).epsilon(1e-14));
    CHECK(law->modulus(0.3 - 1e-12) == Approx(law->modulus(0.3)).epsilon(1e-10));
    CHECK(law->modulus(0.5) == Approx(0.125).epsilon(1e-14));
    for (const double density : {0.05, 0.29, 0.31, 0.8}) check_slope(*law, density);
}

TEST_CASE("penalties that make no sense are refused", "[optimization]") {
    CHECK_THROWS_AS(make_penalty_law({.exponent = 0.9}), InputError);
    CHECK_THROWS_AS(make_penalty_law({.exponent = std::nan("")}), InputError);
    CHECK_THROWS_AS(make_penalty_law({.least = -1e-9}), InputError);
    CHECK_THROWS_AS(make_penalty_law({.least = 1}), InputError);
    CHECK_THROWS_AS(make_penalty_law({.linear_to = 1}), InputError);
    CHECK_THROWS_AS(make_penalty_law({.linear_to = -0.1}), InputError);
}

TEST_CASE("the modulus of a foam is that of its law, for every foam that is shipped", "[optimization]") {
    const std::vector<FoamLawTable> tables = shipped_laws();
    REQUIRE(tables.size() > 10);
    for (const FoamLawTable& table : tables) {
        CAPTURE(table.foam);
        const FoamLaw foam(table, law_poisson);
        const auto law = make_foam_modulus_law(foam, 1e-9);
        for (const FoamLawPoint& computed : table.points) {
            const FoamLawPoint point = foam.at(computed.ratio);
            CHECK(law->modulus(point.density) == Approx(point.young).epsilon(1e-9));
        }
        double before = 0;
        for (int i = 1; i <= 1000; ++i) {
            const double modulus = law->modulus(0.001 * i);
            CHECK(modulus >= before);
            before = modulus;
        }
        CHECK(law->modulus(0) == 1e-9);
        CHECK(law->slope(0) == 0);
        CHECK(law->modulus(1) == Approx(1).epsilon(1e-12));
        // Irrational densities, lest one lies on a sample.
        for (const double density : {0.0314159265, 0.1414213562, 0.2718281828, 0.5772156649, 0.8660254038})
            check_slope(*law, density);
    }
}

TEST_CASE("a foam whose modulus is a power of its density has that law at every density", "[optimization]") {
    const FoamLaw foam({"made up",
                        {{.ratio = 0.1, .density = 0.1, .young = 0.01},
                         {.ratio = 0.2, .density = 0.2, .young = 0.04},
                         {.ratio = 0.3, .density = 0.5, .young = 0.25}}},
                       law_poisson);
    const auto law = make_foam_modulus_law(foam, 1e-6);
    // Below the lightest sample, between samples, and up to the solid.
    for (const double density : {0.002, 0.05, 0.1, 0.15, 0.25, 0.4, 0.7, 1.0}) {
        CHECK(law->modulus(density) == Approx(density * density).epsilon(1e-12));
        if (density < 1) CHECK(law->slope(density) == Approx(2 * density).epsilon(1e-12));
    }
    CHECK(law->modulus(5e-4) == 1e-6);
    CHECK(law->slope(5e-4) == 0);
}

TEST_CASE("the law of a foam without growth is refused", "[optimization]") {
    const FoamLaw foam(
        {"made up",
         {{.ratio = 0.1, .density = 0.2, .young = 0.01}, {.ratio = 0.2, .density = 0.2, .young = 0.04}}},
        law_poisson);
    CHECK_THROWS_AS(make_foam_modulus_law(foam, 1e-6), InputError);
}

}  // namespace modulus_law_test
