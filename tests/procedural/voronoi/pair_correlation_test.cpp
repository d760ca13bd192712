// The statistic on processes with known answers, then on the seeds of graded densities.
#include "tests/procedural/voronoi/pair_correlation.h"

#include <catch2/catch.hpp>
#include <random>

#include "procedural/voronoi/seed_tree.h"
#include "tests/procedural/voronoi/graded_densities.h"

namespace pair_correlation_test {

using namespace lamella;

namespace {

constexpr double bin = 0.1;
constexpr int bins = 30;

std::vector<dvec3> positions(const std::vector<Seed>& seeds) {
    std::vector<dvec3> points;
    for (const Seed& seed : seeds) points.push_back(seed.position);
    return points;
}

/// The surface of a box counted in cells of the local mean spacing, for a density that varies along x.
double cells_on_surface(const Box& box, const std::function<double(double)>& density) {
    const auto per_area = [&](double x) { return std::cbrt(density(x) * density(x)); };
    const dvec3 size = box.size();
    double sides = 0;
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) sides += per_area(box.lo.x + (i + 0.5) * size.x / steps) * size.x / steps;
    return 2 * sides * (size.y + size.z) + (per_area(box.lo.x) + per_area(box.hi.x)) * size.y * size.z;
}

}  // namespace

TEST_CASE("points that know nothing of each other have a pair correlation of one") {
    const unsigned seed = 31;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(0, 1);
    std::vector<dvec3> even, graded;
    for (int i = 0; i < 30 * 30 * 30; ++i) {
        even.emplace_back(30 * at(random), 30 * at(random), 30 * at(random));
        // The density 2 x / 30 by inverting its integral.
        graded.emplace_back(30 * std::sqrt(at(random)), 30 * at(random), 30 * at(random));
    }
    const auto flat = pair_correlation(
        even, {dvec3(3), dvec3(27)}, [](dvec3) { return 1.0; }, bin, bins);
    const auto ramp = pair_correlation(
        graded, {{8, 4, 4}, {26, 26, 26}}, [](dvec3 p) { return p.x / 15; }, bin, bins);
    for (std::size_t k = 5; k < bins; ++k) {
        INFO("at " << (static_cast<double>(k) + 0.5) * bin);
        REQUIRE(flat[k] == Approx(1).margin(0.05));
        REQUIRE(ramp[k] == Approx(1).margin(0.06));
    }
}

TEST_CASE("a cubic lattice has peaks at its distances and nothing between") {
    std::vector<dvec3> points;
    for (int i = 0; i < 20 * 20 * 20; ++i) points.emplace_back(i % 20, i / 20 % 20, i / 400);
    const auto g = pair_correlation(
        points, {dvec3(3.5), dvec3(15.5)}, [](dvec3) { return 1.0; }, bin, bins);
    const double unit = 4 * 3.14159265358979323846 / 3;
    const auto shell = [&](std::size_t k) {
        const double s = static_cast<double>(k) * bin, t = s + bin;
        return unit * (t * t * t - s * s * s);
    };
    // 6 neighbours at 1, 12 at sqrt 2, 8 at sqrt 3.
    REQUIRE(g[10] == Approx(6 / shell(10)));
    REQUIRE(g[14] == Approx(12 / shell(14)));
    REQUIRE(g[17] == Approx(8 / shell(17)));
    for (const std::size_t k : {0, 5, 9, 11, 12, 13, 15, 16, 18, 19}) REQUIRE(g[k] == 0);
}

TEST_CASE("seeds of a graded density keep apart, and show no lattice beyond") {
    const auto ramp = std::make_shared<RampDensity>(1.0, 0.5);
    const auto at = [&](dvec3 p) { return ramp->at(p.x); };
    for (const double side : {2.0, 3.3, 8.0}) {
        INFO("coarse side " << side);
        const SeedTree tree(ramp, side, 1);
        const auto points = positions(tree.seeds_in({{-1.5, -3, -3}, {20, 13, 13}}));
        const auto g = pair_correlation(points, {{1.7, 0, 0}, {17.9, 10, 10}}, at, bin, bins);
        for (std::size_t k = 0; k < bins; ++k) {
            const double s = (static_cast<double>(k) + 0.5) * bin;
            INFO("g(" << s << ") = " << g[k]);
            if (s < 0.3) CHECK(g[k] < 0.6);
            CHECK(g[k] < 1.1);
            if (s > 1.2) CHECK(g[k] > 0.9);
        }
    }
}

TEST_CASE("boxes hold as many seeds as the density's integral says, to the cells of their surface") {
    const unsigned seed = 12;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> corner(0, 12), size(2, 8);
    const auto ramp = std::make_shared<RampDensity>(1.0, 0.5);
    for (const double side : {2.0, 3.3, 8.0}) {
        const SeedTree tree(ramp, side, 5);
        double squares = 0, surplus = 0;
        constexpr int boxes = 300;
        for (int i = 0; i < boxes; ++i) {
            const dvec3 lo(corner(random), corner(random), corner(random));
            const Box box{lo, lo + dvec3(size(random), size(random), size(random))};
            const double expected = ramp->integral(box);
            const double difference = static_cast<double>(tree.seeds_in(box).size()) - expected;
            const double cells = cells_on_surface(box, [&](double x) { return ramp->at(x); });
            INFO("box " << i << ": " << expected << " expected, " << difference << " more, " << cells
                        << " cells on its surface");
            REQUIRE(std::abs(difference) < 4 * std::sqrt(0.3 * cells));
            squares += difference * difference / cells;
            surplus += difference / expected;
        }
        INFO("coarse side " << side << ": mean square " << squares / boxes << " of the cells, mean surplus "
                            << surplus / boxes);
        CHECK(squares / boxes < 0.3);
        CHECK(std::abs(surplus / boxes) < 0.01);
    }
}

}  // namespace pair_correlation_test
