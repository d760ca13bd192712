// Examples of arrangements: read as they are written, and their statistics found again in what is spread.
#include "procedural/elements/element_arrangement.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elements/element_plan.h"
#include "procedural/elements/element_spread.h"
#include "procedural/voronoi/counter_hash.h"

namespace element_arrangement_test {

using namespace lamella;

namespace {

std::string refusal(const std::string& text) {
    try {
        read_arrangement(text, "a.csv", {.shapes = 2, .scales = {0.5, 2}});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

double random(std::int64_t k, std::uint64_t which) { return CounterHash(7, 0, k, 0, 0).uniform(which); }

/// Elements of two shapes, one in three the second, in a lattice from which chance takes them by up to
/// `astray` of its spacing; they lie nearly along 30 degrees, and the second ones are larger.
std::vector<PlacedElement> lattice(int side, double astray) {
    std::vector<PlacedElement> elements;
    for (int k = 0; k < side * side; ++k) {
        const int row = k / side;
        const dvec2 aside(random(k, 0) - 0.5, random(k, 1) - 0.5);
        const double angle = std::numbers::pi / 6 + 0.2 * (random(k, 2) - 0.5);
        elements.push_back({.shape = k % 3 == 0 ? 1U : 0U,
                            .at = {k % side + 2 * astray * aside.x, row + 2 * astray * aside.y, 0},
                            .turn = glm::angleAxis(angle, dvec3(0, 0, 1)),
                            .scale = k % 3 == 0 ? 1.5 : 1});
    }
    return elements;
}

/// A plate 60 x 60 in squares of 0.25 mm.
SpreadSites plate() {
    SpreadSites sites{.spacing = 0.25, .is_flat = true};
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 240; ++x) sites.places.emplace_back(0.25 * x + 0.125, 0.25 * y + 0.125, 0);
    }
    sites.sizes.assign(sites.size(), 1);
    sites.densities.assign(sites.size(), 1);
    return sites;
}

}  // namespace

TEST_CASE("arrangements read as they are written", "[elements]") {
    std::vector<PlacedElement> elements = lattice(3, 0.4);
    elements[4].turn = glm::normalize(glm::dquat(0.3, -0.5, 0.1, 0.8));
    std::ostringstream out;
    write_elements(out, elements);
    const auto read = [](const std::string& text) {
        return read_arrangement(text, "a.csv", {.shapes = 2, .scales = {1, 1.5}});
    };
    const std::vector<PlacedElement> back = read(out.str());
    REQUIRE(back.size() == elements.size());
    for (std::size_t k = 0; k < back.size(); ++k) {
        CHECK(back[k].shape == elements[k].shape);
        CHECK(back[k].at == elements[k].at);
        CHECK(back[k].scale == elements[k].scale);
        CHECK(std::abs(glm::dot(back[k].turn, elements[k].turn)) == Approx(1));
    }
    // As spreadsheets and hands write them.
    const auto by_hand = read(
        "\xEF\xBB\xBFshape,x,y,z,qw,qx,qy,qz,scale\r\n\r\n"
        "0, 1, 2, 3, 2, 0, 0, 0, 1\r\n1,4,5,6,0,0,0,-3,1.25\r\n");
    REQUIRE(by_hand.size() == 2);
    CHECK(by_hand[0].at == dvec3(1, 2, 3));
    CHECK(by_hand[0].turn == glm::dquat(1, 0, 0, 0));
    CHECK(by_hand[1].turn == glm::dquat(0, 0, 0, -1));
    CHECK(by_hand[1].scale == 1.25);
}

TEST_CASE("arrangements that are none say where", "[elements]") {
    const std::string good = "0,1,2,3,1,0,0,0,1\n";
    CHECK(refusal(good + good).empty());
    CHECK(refusal(good + "0,1,2,3,1,0,0,0\n").starts_with("a.csv:2: \"0,1,2,3,1,0,0,0\" is no element"));
    CHECK(refusal(good + good + "0,1,2,3,1,0,0,0,1,5\n").starts_with("a.csv:3: "));
    CHECK(refusal(good + "0,1,2,3,1,0,0,0,x\n").starts_with("a.csv:2: "));
    CHECK(refusal(good + "0,1,nan,3,1,0,0,0,1\n").starts_with("a.csv:2: "));
    CHECK(refusal(good + "2,1,2,3,1,0,0,0,1\n").starts_with("a.csv:2: there is no shape 2; accepted"));
    CHECK(refusal(good + "0.5,1,2,3,1,0,0,0,1\n").starts_with("a.csv:2: there is no shape 0.5"));
    CHECK(refusal(good + "0,1,2,3,0,0,0,0,1\n").starts_with("a.csv:2: a quaternion of length 0"));
    CHECK(refusal(good + "0,1,2,3,1,0,0,0,2.5\n").starts_with("a.csv:2: a scale of 2.5 is outside"));
    CHECK(refusal(good).starts_with("a.csv: 1 element; accepted"));
    CHECK(refusal("").starts_with("a.csv: 0 elements; accepted"));
    CHECK(refusal(good + std::string(5000, '1')).starts_with("a.csv:2: "));
}

TEST_CASE("spacings vary as theory says", "[elements]") {
    CHECK(spacing_variation(lattice(12, 0)) == 0);
    // Distances to the nearest of points at random in a plane have a Rayleigh distribution (Clark, Evans
    // 1954).
    std::vector<PlacedElement> random_ones(40'000);
    for (std::size_t k = 0; k < random_ones.size(); ++k) {
        const auto number = static_cast<std::int64_t>(k);
        random_ones[k].at = {random(number, 0), random(number, 1), 0};
    }
    CHECK(spacing_variation(random_ones) == Approx(std::sqrt(4 / std::numbers::pi - 1)).epsilon(0.02));
    CHECK(spacing_variation(std::vector<PlacedElement>(3)) == 0);  // all in one place
}

TEST_CASE("elements are spread as unevenly and turned as those of an example", "[elements]") {
    const SpreadSites sites = plate();
    const std::vector<ElementShapePtr> shapes{make_stick(1.2, 0.8), make_ring(1.4, 0.3)};
    const double astray = GENERATE(0.25, 0.35, 0.45);
    const std::vector<PlacedElement> example = lattice(15, astray);
    const double variation = spacing_variation(example);
    CAPTURE(astray, variation);
    const SpreadSettings settings{
        .count = 450, .scale = {1, 1.5}, .example = example, .variation = variation, .seed = 3};
    const std::vector<PlacedElement> spread = spread_elements(sites, shapes, settings);
    CHECK(spacing_variation(spread) == Approx(variation).epsilon(0.1));
    // Each of the 225 twice.
    std::map<std::pair<double, double>, int> turns;
    for (const PlacedElement& e : spread) {
        CHECK(e.scale == (e.shape == 1 ? 1.5 : 1));
        const dvec3 x = e.turn * dvec3(1, 0, 0);
        ++turns[{std::round(1e9 * x.x), std::round(1e9 * x.y)}];
    }
    CHECK(turns.size() == 225);
    CHECK(std::ranges::all_of(turns, [](const auto& turn) { return turn.second == 2; }));

    SpreadSites along = sites;
    along.ways.assign(along.size(), dvec3(0, 1, 0));
    SpreadSettings turned = settings;
    turned.is_aligned = true;
    for (const PlacedElement& e : spread_elements(along, shapes, turned)) {
        const dvec3 x = e.turn * dvec3(1, 0, 0);
        CHECK(std::atan2(x.y, x.x) == Approx(std::numbers::pi * (0.5 + 1.0 / 6)).margin(0.1001));
    }
    ThreadArena arena(3);
    CHECK(arena.execute([&] { return spread_elements(sites, shapes, settings); }) == spread);
}

}  // namespace element_arrangement_test
