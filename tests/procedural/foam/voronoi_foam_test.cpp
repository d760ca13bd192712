// The foam as a field: its distance, its planes, its volume, its one piece, and its refusals.
#include "procedural/foam/voronoi_foam.h"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "engine/base/error.h"
#include "procedural/foam/beam_box.h"
#include "procedural/voronoi/counter_hash.h"

namespace voronoi_foam_test {

using namespace lamella;

namespace {

FoamSettings settings(double cell, double radius, Box region = {dvec3(0), dvec3(10)}) {
    FoamSettings s;
    s.cell = cell;
    s.beam_radius = radius;
    s.seed = 17;
    s.region = region;
    return s;
}

dvec3 random_point(const Box& box, std::int64_t i) {
    const CounterHash hash(23, 0, i, 0, 0);
    return box.lo + box.size() * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2));
}

}  // namespace

TEST_CASE("the foam's value is the distance to the nearest of all beams", "[voronoi_foam]") {
    const VoronoiFoam foam(settings(1.7, 0.2));
    const Box box{dvec3(-3), dvec3(3)};
    const auto beams = foam.beams_touching(grown(box, 4));
    for (int i = 0; i < 3000; ++i) {
        const dvec3 p = random_point(box, i);
        double expected = infinity;
        for (const Beam& beam : beams) expected = std::min(expected, signed_distance(beam, p));
        REQUIRE(foam.value(p) == expected);
    }
    CHECK(std::isnan(foam.value({std::nan(""), 0, 0})));
    CHECK(std::isnan(foam.value({infinity, 0, 0})));
}

TEST_CASE("ranges enclose the values of their box", "[voronoi_foam]") {
    const VoronoiFoam foam(settings(1.7, 0.2));
    for (int i = 0; i < 50; ++i) {
        const dvec3 corner = random_point(foam.bounds(), i);
        const Box box{corner, corner + 0.4};
        const Interval range = foam.range(box);
        for (int k = 0; k < 50; ++k) CHECK(range.contains(foam.value(random_point(box, 1000 + k))));
        CHECK(range.width() < 2);
    }
}

TEST_CASE("the beams at a height are those of the region that meet the plane", "[voronoi_foam]") {
    const VoronoiFoam foam(settings(1.7, 0.2, {dvec3(-4, 1, 0), dvec3(9, 6, 12)}));
    const auto all = foam.beams_touching(foam.bounds());
    for (const double z : {0.0, 0.025, 3.4, 5.1, 11.9}) {
        const auto at = foam.beams_at(z);
        std::vector<Beam> expected;
        for (const Beam& beam : all) {
            if (touches(beam, {{-4, 1, z}, {9, 6, z}})) expected.push_back(beam);
        }
        CHECK(at == expected);
        CHECK(at.size() > 20);
    }
}

TEST_CASE("the solid fraction follows the measured law", "[voronoi_foam]") {
    for (const double t : {0.07, 0.10, 0.14, 0.20}) {
        CAPTURE(t);
        constexpr int samples = 40000;
        const Box box{dvec3(0), dvec3(7)};
        const VoronoiFoam foam(settings(1, t, box));
        int solid = 0;
        for (int i = 0; i < samples; ++i) solid += foam.value(random_point(box, i)) < 0;
        CHECK(static_cast<double>(solid) / samples ==
              Approx(foam.expected_volume_fraction(dvec3(0))).epsilon(0.04));
    }
    CHECK(VoronoiFoam(settings(1, 0.15)).expected_volume_fraction(dvec3(0)) == Approx(0.27675));
    CHECK(VoronoiFoam(settings(1, 0.499)).expected_volume_fraction(dvec3(0)) <= 1);
}

TEST_CASE("the beams of a box hang together in one piece", "[voronoi_foam]") {
    const VoronoiFoam foam(settings(1, 0.1));
    const auto beams = foam.beams_touching({dvec3(0), dvec3(8)});
    // Nodes shared by beams have the same bits, so they can be looked up exactly.
    std::map<std::array<double, 3>, std::size_t> nodes;
    std::vector<std::size_t> parent;
    std::map<std::size_t, int> degree;
    const auto find = [&](std::size_t n) {
        while (parent[n] != n) n = parent[n] = parent[parent[n]];
        return n;
    };
    const auto id = [&](dvec3 p) {
        const auto [entry, fresh] = nodes.try_emplace({p.x, p.y, p.z}, nodes.size());
        if (fresh) parent.push_back(parent.size());
        return entry->second;
    };
    for (const Beam& beam : beams) {
        const auto a = id(beam.a), b = id(beam.b);
        ++degree[a];
        ++degree[b];
        parent[find(a)] = find(b);
    }
    std::map<std::size_t, int> pieces;
    std::size_t inner = 0;
    for (const auto& [place, node] : nodes) {
        const dvec3 p(place[0], place[1], place[2]);
        if (!Box{dvec3(1), dvec3(7)}.contains(p)) continue;
        CHECK(degree[node] == 4);
        ++pieces[find(node)];
        ++inner;
    }
    CHECK(pieces.size() == 1);
    // A cell has about 27 vertices, each shared by four.
    CHECK(static_cast<double>(inner) / 216 == Approx(6.6).epsilon(0.1));
}

TEST_CASE("the foam does not depend on the region", "[voronoi_foam]") {
    const VoronoiFoam wide(settings(2, 0.3, {dvec3(-20), dvec3(20)})), narrow(settings(2, 0.3));
    const Box box{{1, 2, 3}, {6, 5, 4}};
    CHECK(wide.beams_touching(box) == narrow.beams_touching(box));
    CHECK(wide.seeds_in(box) == narrow.seeds_in(box));
    CHECK(wide.value({3, 3, 3}) == narrow.value({3, 3, 3}));
}

TEST_CASE("growing the foam shifts its value", "[voronoi_foam]") {
    const VoronoiFoam foam(settings(2, 0.3));
    const auto grown_foam = foam.offset(0.25);
    REQUIRE(grown_foam);
    for (int i = 0; i < 200; ++i) {
        const dvec3 p = random_point(foam.bounds(), i);
        CHECK(grown_foam->value(p) == Approx(foam.value(p) - 0.25).margin(1e-12));
    }
    CHECK(grown_foam->bounds().lo.x == -0.25);
    CHECK(foam.offset(2) != nullptr);
    CHECK(foam.offset(-0.1) == nullptr);
}

TEST_CASE("settings out of range are refused with a sentence", "[voronoi_foam]") {
    CHECK_THROWS_AS(VoronoiFoam(settings(0, 0.1)), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(-1, 0.1)), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(std::nan(""), 0.1)), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(1, 0)), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(1, 0.5)), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(1, 0.1, Box{})), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(1, 0.1, {dvec3(-infinity), dvec3(infinity)})), InputError);
    CHECK_THROWS_AS(VoronoiFoam(settings(1e-4, 1e-5, {dvec3(0), dvec3(100)})), InputError);
    CHECK_THROWS_WITH(VoronoiFoam(settings(1, 0.6)), Catch::Contains("less than 0.5 mm"));
    CHECK(make_voronoi_foam(settings(1, 0.1))->metric() == Metric::bound);
}

}  // namespace voronoi_foam_test
