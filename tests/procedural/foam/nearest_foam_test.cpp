// The k-nearest foam against brute force over all seeds about, and its directions.
#include "procedural/foam/nearest_foam.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "engine/base/error.h"
#include "procedural/foam/beam_box.h"
#include "tests/engine/field/gradings.h"

namespace nearest_foam_test {

using namespace lamella;

namespace {

NearestFoamSettings settings(Graded cell, double beam) {
    NearestFoamSettings s;
    s.foam.cell = std::move(cell);
    s.foam.beam_radius = beam;
    s.foam.region = {dvec3(-10), dvec3(10)};
    s.foam.seed = 5;
    return s;
}

using Pair = std::pair<SeedKey, SeedKey>;

/// Every pair of which one is among the k nearest of the other, by sorting all seeds.
std::set<Pair> brute_pairs(const std::vector<Seed>& seeds, const Box& core, const NearestFoamSettings& s) {
    std::set<Pair> pairs;
    for (const Seed& own : seeds) {
        if (!core.contains(own.position)) continue;
        const glm::dmat3 axes = turned_axes(
            {s.turn[0]->at(own.position), s.turn[1]->at(own.position), s.turn[2]->at(own.position)});
        std::vector<std::pair<double, SeedKey>> others;
        for (const Seed& other : seeds) {
            if (other.key == own.key) continue;
            double square = 0;
            for (int i = 0; i < 3; ++i) {
                const double along = glm::dot(axes[i], other.position - own.position) /
                                     s.stretch[static_cast<std::size_t>(i)]->at(own.position);
                square += along * along;
            }
            others.push_back({square, other.key});
        }
        std::partial_sort(others.begin(), others.begin() + s.neighbours, others.end());
        for (int i = 0; i < s.neighbours; ++i) {
            const SeedKey other = others[static_cast<std::size_t>(i)].second;
            pairs.insert({std::min(own.key, other), std::max(own.key, other)});
        }
    }
    return pairs;
}

void check_against_brute_force(const NearestFoamSettings& s, double margin) {
    const NearestFoam foam(s);
    const Box box{dvec3(-1), dvec3(1.5)};
    const auto seeds = foam.seeds_in(grown(box, 2 * margin));
    std::map<SeedKey, dvec3> position;
    for (const Seed& seed : seeds) position[seed.key] = seed.position;
    std::vector<Beam> expected;
    for (const auto& [a, b] : brute_pairs(seeds, grown(box, margin), s)) {
        const double r = s.foam.beam_radius->at(dvec3(0));
        if (const Beam beam{position[a], r, position[b], r}; touches(beam, box)) expected.push_back(beam);
    }
    const auto beams = foam.beams_touching(box);
    CHECK(beams.size() > 10);
    CHECK(beams.size() == expected.size());
    for (const Beam& beam : expected) {
        const Beam reversed{beam.b, beam.rb, beam.a, beam.ra};
        CHECK(std::count(beams.begin(), beams.end(), beam) +
                  std::count(beams.begin(), beams.end(), reversed) ==
              1);
    }
}

}  // namespace

TEST_CASE("beams go to the k nearest seeds, each once", "[nearest_foam]") {
    for (const int k : {1, 4, 9}) {
        NearestFoamSettings s = settings(1.1, 0.1);
        s.neighbours = k;
        check_against_brute_force(s, 3);
    }
}

TEST_CASE("the nearest are found in graded densities too", "[nearest_foam]") {
    check_against_brute_force(settings(std::make_shared<const Ramp>(-3, 0.8, 4, 2), 0.05), 4);
    check_against_brute_force(settings(std::make_shared<const Step>(0.3, 0.9, 2), 0.05), 4);
}

TEST_CASE("the metric may turn and stretch from place to place", "[nearest_foam]") {
    NearestFoamSettings s = settings(1.0, 0.1);
    s.stretch = {std::make_shared<const Ramp>(-3, 1, 3, 2.5), 1.0, 0.6};
    s.turn = {10.0, std::make_shared<const Ramp>(-3, 0, 3, 80), 25.0};
    check_against_brute_force(s, 4);
}

TEST_CASE("beams lean to the axis along which the metric is stretched", "[nearest_foam]") {
    const auto lean = [](double factor) {
        NearestFoamSettings s = settings(1.0, 0.1);
        s.stretch[2] = factor;
        const NearestFoam foam(s);
        double sum = 0;
        const auto beams = foam.beams_touching({dvec3(-4), dvec3(4)});
        for (const Beam& b : beams) sum += std::abs(b.b.z - b.a.z) / glm::distance(b.a, b.b);
        return sum / static_cast<double>(beams.size());
    };
    CHECK(lean(1) == Approx(0.5).epsilon(0.05));  // the mean of |cos| over the sphere
    CHECK(lean(3) > 0.75);
    CHECK(lean(1 / 3.0) < 0.25);
}

TEST_CASE("settings of a k-nearest foam out of range are refused", "[nearest_foam]") {
    NearestFoamSettings s = settings(1.0, 0.1);
    s.neighbours = 0;
    CHECK_THROWS_WITH(NearestFoam(s), Catch::Contains("0 neighbours"));
    s.neighbours = 5;
    s.stretch[1] = -1.0;
    CHECK_THROWS_WITH(NearestFoam(s), Catch::Contains("stretch reaches -1"));
    s.stretch[1] = 1.0;
    s.foam.stretch = Stretch(turned_axes(dvec3(0)), {1, 2, 1});
    CHECK_THROWS_AS(NearestFoam(s), InputError);
}

}  // namespace nearest_foam_test
