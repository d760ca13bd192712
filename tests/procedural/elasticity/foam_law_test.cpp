// Laws of foams: between their points, beyond them, back again, and as text.
#include "procedural/elasticity/foam_law.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "engine/base/error.h"

namespace foam_law_test {

using namespace lamella;

namespace {

/// A law that is a power of the ratio, softer and stiffer by a tenth with other materials.
FoamLawTable power_law(double exponent) {
    FoamLawTable table{"open", {}};
    for (const double ratio : {0.03, 0.05, 0.08, 0.12, 0.2})
        table.points.push_back(
            {ratio, 10 * ratio * ratio, 2 * std::pow(ratio, exponent), 0.3, 0.9, 1.1, 0.02, 0.03, 64, 4});
    return table;
}

std::string refusal(const std::string& text) {
    try {
        read_foam_laws(text, "law.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a power law stays one between its points, forth and back", "[elasticity]") {
    for (const double exponent : {1.0, 3.0, 3.7}) {
        const FoamLaw law(power_law(exponent), law_poisson);
        CHECK(law.ratios().lo == 0.03);
        CHECK(law.moduli().hi == Approx(2 * std::pow(0.2, exponent)));
        for (double ratio = 0.03; ratio < 0.2; ratio *= 1.07) {
            const double young = 2 * std::pow(ratio, exponent);
            CHECK(law.ratio_of(young) == Approx(ratio).epsilon(1e-12));
            CHECK(law.at(ratio).young == Approx(young).epsilon(1e-12));
        }
    }
}

TEST_CASE("a law ends where nothing was computed", "[elasticity]") {
    const FoamLaw law(power_law(3), law_poisson);
    CHECK(law.ratio_of(0) == 0.03);
    CHECK(law.ratio_of(-1) == 0.03);
    CHECK(law.ratio_of(1) == 0.2);
    CHECK(law.at(1e-3).ratio == 0.03);
    CHECK(law.at(5).ratio == 0.2);
    CHECK(std::isnan(law.ratio_of(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("what the material's Poisson's ratio changes is exact where it was computed", "[elasticity]") {
    const double middle = FoamLaw(power_law(3), law_poisson).at(0.08).young;
    CHECK(FoamLaw(power_law(3), low_poisson).at(0.08).young == Approx(0.9 * middle));
    CHECK(FoamLaw(power_law(3), high_poisson).at(0.08).young == Approx(1.1 * middle));
    const double between = FoamLaw(power_law(3), 0.4).at(0.08).young;
    CHECK(between > middle);
    CHECK(between < 1.1 * middle);
    CHECK_THROWS_AS(FoamLaw(power_law(3), 0.5), InputError);
}

TEST_CASE("a law that does not stiffen is none", "[elasticity]") {
    FoamLawTable falling = power_law(3);
    falling.points[2].young = falling.points[1].young;
    CHECK_THROWS_AS(FoamLaw(falling, law_poisson), InputError);
    FoamLawTable single = power_law(3);
    single.points.resize(1);
    CHECK_THROWS_AS(FoamLaw(single, law_poisson), InputError);
    FoamLawTable negative = power_law(3);
    negative.points[0].young = -1;
    CHECK_THROWS_AS(FoamLaw(negative, law_poisson), InputError);
}

TEST_CASE("laws are read as they are written, several to a file", "[elasticity]") {
    std::string text = "# how they were made\n" + law_heading();
    for (const FoamLawPoint& point : power_law(3).points) text += law_row("open", point);
    for (const FoamLawPoint& point : power_law(2).points) text += law_row("other/jitter=0.05", point);
    const std::vector<FoamLawTable> laws = read_foam_laws(text, "law.csv");
    REQUIRE(laws.size() == 2);
    CHECK(laws[0].foam == "open");
    CHECK(laws[1].foam == "other/jitter=0.05");
    REQUIRE(laws[1].points.size() == 5);
    const FoamLawPoint &is = laws[0].points[3], was = power_law(3).points[3];
    CHECK(is.ratio == was.ratio);
    CHECK(is.young == Approx(was.young).epsilon(1e-3));
    CHECK(is.low_factor == Approx(0.9).epsilon(1e-3));
    CHECK(is.spread == was.spread);
    CHECK(is.elements == 64);
    CHECK(is.samples == 4);
}

TEST_CASE("a law's counts that are no numbers are none", "[elasticity]") {
    const std::vector<FoamLawTable> laws =
        read_foam_laws(law_heading() + "open,0.1,0.2,0.03,1,0.03,0.03,nan,nan,nan,-inf\n", "law.csv");
    CHECK(laws.at(0).points.at(0).elements == 0);
    CHECK(laws.at(0).points.at(0).samples == 0);
}

TEST_CASE("what is no law's file is refused with its line", "[elasticity]") {
    CHECK(refusal("1,2,3\n").find("law.csv:1: this is no foam's law") == 0);
    CHECK(refusal("").find("law.csv: there is no foam's law") == 0);
    CHECK(refusal(law_heading() + "open,0.1,0.2\n").find("law.csv:2: a row of a law has 11 cells") == 0);
    CHECK(refusal(law_heading() + "open,0.1,a,1,1,1,1,1,1,1,1\n").find("law.csv:2: \"a\" is not a number") ==
          0);
    CHECK(refusal(law_heading() + "open,0.1,0.2,0,1,1,1,1,1,1,1\n").find("law.csv:2: a ratio or modulus") ==
          0);
}

}  // namespace foam_law_test
