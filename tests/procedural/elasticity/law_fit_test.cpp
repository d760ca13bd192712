// Laws fitted to tests, and cells and members that follow from moduli.
#include "procedural/elasticity/law_fit.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "procedural/elasticity/modulus_grading.h"

namespace law_fit_test {

using namespace lamella;

namespace {

FoamLaw cubic_law() {
    FoamLawTable table{"open", {}};
    for (const double ratio : {0.03, 0.05, 0.08, 0.12, 0.2})
        table.points.push_back(
            {ratio, 10 * ratio * ratio, 20 * std::pow(ratio, 3), 0.3, 1, 1, 0.02, 0, 64, 4});
    return {table, law_poisson};
}

/// What a printer that prints thick beams too thick would show.
double measured(double ratio) { return 1500 * std::pow(20 * std::pow(ratio, 3), 1.1); }

/// x grows by 1 mm over 100 mm, so that formulas are not needed.
class Slope : public Grading {
  public:
    Slope(double base, double per_mm) : base_(base), per_mm_(per_mm) {}
    double at(dvec3 p) const override { return base_ + per_mm_ * p.x; }
    Interval range(const Box& box) const override {
        return {base_ + per_mm_ * box.lo.x, base_ + per_mm_ * box.hi.x};
    }

  private:
    double base_, per_mm_;
};

}  // namespace

TEST_CASE("a law in a material is that of its modulus", "[elasticity]") {
    const FoamModulus foam(cubic_law(), 2000);
    CHECK(foam.modulus_of(0.1) == Approx(2000 * 0.02).epsilon(1e-3));
    CHECK(foam.ratio_of(foam.modulus_of(0.07)) == Approx(0.07));
    CHECK(foam.band() == Approx(std::hypot(0.04, 0.02)));
    CHECK(foam.moduli().hi == Approx(2000 * 0.16));
    CHECK_THROWS_AS(FoamModulus(cubic_law(), 0), InputError);
}

TEST_CASE("tests without scatter are met exactly: one by the scale, three by the exponent too",
          "[elasticity]") {
    std::vector<StiffnessTest> tests{{0.1, measured(0.1)}};
    const FoamModulus one(cubic_law(), 2000, tests);
    CHECK(one.fit().exponent == 1);
    CHECK(one.modulus_of(0.1) == Approx(measured(0.1)));
    CHECK(one.band() == Approx(std::hypot(0.04, 0.02)));  // a single test says nothing of scatter
    tests.push_back({0.05, measured(0.05)});
    tests.push_back({0.15, measured(0.15)});
    const FoamModulus three(cubic_law(), 2000, tests);
    CHECK(three.fit().exponent == Approx(1.1).epsilon(1e-3));
    CHECK(three.fit().scale == Approx(1500).epsilon(1e-2));
    for (const double ratio : {0.04, 0.09, 0.18}) {
        CHECK(three.modulus_of(ratio) == Approx(measured(ratio)).epsilon(2e-3));
        CHECK(three.ratio_of(measured(ratio)) == Approx(ratio).epsilon(1e-3));
    }
}

TEST_CASE("the error band holds 19 of 20 further samples", "[elasticity]") {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.08);
    std::uniform_real_distribution<double> anywhere(0.05, 0.15);
    int inside = 0, all = 0;
    for (int run = 0; run < 400; ++run) {
        std::vector<StiffnessTest> tests;
        for (int i = 0; i < 8; ++i) {
            const double ratio = 0.05 + 0.1 * i / 7;
            tests.push_back({ratio, measured(ratio) * std::exp(noise(random))});
        }
        const FoamModulus foam(cubic_law(), 2000, tests);
        for (int i = 0; i < 20; ++i, ++all) {
            const double ratio = anywhere(random), young = measured(ratio) * std::exp(noise(random));
            inside += std::abs(std::log(young / foam.modulus_of(ratio))) < std::log1p(foam.band());
        }
    }
    CHECK(static_cast<double>(inside) / all == Approx(0.95).margin(0.02));
}

TEST_CASE("tests that say nothing are refused", "[elasticity]") {
    const auto fit = [](std::vector<StiffnessTest> tests) { return FoamModulus(cubic_law(), 2000, tests); };
    CHECK_THROWS_AS(fit({{0.5, 100}}), InputError);
    CHECK_THROWS_AS(fit({{0.1, 0}}), InputError);
    CHECK_THROWS_AS(fit({{0.05, 100}, {0.1, 90}, {0.15, 80}}), InputError);
}

TEST_CASE("cells and members that follow from a modulus have it", "[elasticity]") {
    const auto foam = std::make_shared<const FoamModulus>(cubic_law(), 2000);
    const auto modulus = std::make_shared<Slope>(20, 0.5), size = std::make_shared<Slope>(0.4, 0.002);
    const GradingPtr cell = make_cell_for_modulus(modulus, size, foam),
                     member = make_member_for_modulus(modulus, size, foam),
                     by_cell = make_modulus_of(cell, size, foam),
                     by_member = make_modulus_of(size, member, foam);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 100);
    for (int i = 0; i < 200; ++i) {
        const dvec3 p{place(random), 0, 0};
        CHECK(by_cell->at(p) == Approx(modulus->at(p)).epsilon(1e-9));
        CHECK(by_member->at(p) == Approx(modulus->at(p)).epsilon(1e-9));
        const double other = place(random);
        const Box box{{std::min(p.x, other), -1, -1}, {std::max(p.x, other), 1, 1}};
        for (const GradingPtr& each : {cell, member, by_cell, by_member}) {
            const Interval range = each->range(box);
            CHECK(range.contains(each->at(p)));
            CHECK(range.contains(each->at({other, 0, 0})));
            CHECK(range.contains(each->at({(p.x + other) / 2, 0, 0})));
        }
    }
    CHECK_FALSE(cell->constant());
    const GradingPtr same =
        make_cell_for_modulus(make_constant_grading(40), make_constant_grading(0.3), foam);
    CHECK(same->constant().value() == Approx(3).epsilon(1e-3));
}

}  // namespace law_fit_test
