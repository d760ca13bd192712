// Planes served from slabs, against the query asked for each plane anew.
#include "procedural/foam/piece_slabs.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <random>

#include "engine/base/parallel.h"
#include "procedural/foam/voronoi_foam.h"
#include "tests/engine/field/gradings.h"

namespace piece_slabs_test {

using namespace lamella;

namespace {

const Rect left{{0, 0}, {4, 8}}, right{{4, 0}, {8, 8}};

VoronoiFoam graded_foam() {
    FoamSettings settings;
    settings.cell = std::make_shared<const Ramp>(0, 0.8, 8, 2);
    settings.beam_radius = 0.12;
    settings.region = {dvec3(0), dvec3(8)};
    return VoronoiFoam(settings);
}

bool heights_hold(const Beam& beam, double z) {
    const Box box = bounds(beam);
    return box.lo.z <= z && z <= box.hi.z;
}

/// What a plane needs, and nothing of other heights, in the order of the foam.
void check_plane(const std::vector<Beam>& found, const VoronoiFoam& foam, const Rect& rect, double z) {
    const auto needed = foam.beams_touching({dvec3(rect.lo, z), dvec3(rect.hi, z)});
    auto at = found.begin();
    for (const Beam& beam : needed) {
        at = std::find(at, found.end(), beam);
        REQUIRE(at != found.end());
    }
    CHECK(std::all_of(found.begin(), found.end(), [&](const Beam& b) { return heights_hold(b, z); }));
    CHECK(needed.size() > 20);
}

}  // namespace

TEST_CASE("a slab serves every plane within it with what the plane needs", "[piece_slabs]") {
    const VoronoiFoam foam = graded_foam();
    const PieceSlabs<Beam> slabs(0.3, 2);
    const auto query = [&](const Box& box) { return foam.beams_touching(box); };
    std::mt19937 random(3);
    std::uniform_real_distribution<double> height(0, 8);
    for (int i = 0; i < 40; ++i) {
        // Random planes, and such that lie on the border of two slabs.
        const double z = i % 2 ? height(random) : 0.3 * std::floor(height(random) / 0.3);
        check_plane(slabs.at(0, left, z, query).beams, foam, left, z);
        check_plane(slabs.at(1, right, z, query).beams, foam, right, z);
    }
}

TEST_CASE("planes below the origin are served too", "[piece_slabs]") {
    const VoronoiFoam foam = graded_foam();
    const PieceSlabs<Beam> slabs(0.3, 1);
    const auto query = [&](const Box& box) { return foam.beams_touching(box); };
    for (const double z : {-0.1, -0.3, -5.05}) check_plane(slabs.at(0, left, z, query).beams, foam, left, z);
}

TEST_CASE("layers of a slab ask once, and a slab left behind is asked for again", "[piece_slabs]") {
    int asked = 0;
    const auto query = [&](const Box& box) {
        ++asked;
        CHECK(box.size().z < 1.01);
        return std::vector<Beam>{{box.center(), 0.5, box.center(), 0.5}};
    };
    const PieceSlabs<Beam> slabs(1, 1);
    for (int layer = 0; layer < 20; ++layer) slabs.at(0, left, 0.05 * layer, query);
    CHECK(asked == 1);
    // Layers in flight about a border do not drive each other's slab out.
    for (int i = 0; i < 10; ++i) slabs.at(0, left, i % 2 ? 0.95 : 1.05, query);
    CHECK(asked == 2);
    for (const double z : {2.5, 3.5, 4.5, 0.5}) slabs.at(0, left, z, query);
    CHECK(asked == 6);
}

TEST_CASE("threads share slabs and find the same planes", "[piece_slabs]") {
    const VoronoiFoam foam = graded_foam();
    const PieceSlabs<Beam> slabs(0.25, 1), alone(0.25, 1);
    std::atomic<int> asked = 0;
    const auto query = [&](const Box& box) {
        ++asked;
        return foam.beams_touching(box);
    };
    std::vector<std::vector<Beam>> planes(60);
    parallel_for(planes.size(), [&](std::size_t i) {
        planes[i] = slabs.at(0, left, 0.05 * static_cast<double>(i), query).beams;
    });
    const auto quiet = [&](const Box& box) { return foam.beams_touching(box); };
    for (std::size_t i = 0; i < planes.size(); ++i) {
        CHECK(planes[i] == alone.at(0, left, 0.05 * static_cast<double>(i), quiet).beams);
    }
    CHECK(asked >= 12);
}

TEST_CASE("a query that fails is asked again", "[piece_slabs]") {
    const PieceSlabs<Beam> slabs(1, 1);
    const auto failing = [](const Box&) -> std::vector<Beam> { throw std::runtime_error("no seeds"); };
    CHECK_THROWS_AS(slabs.at(0, left, 0.5, failing), std::runtime_error);
    const auto query = [](const Box& box) {
        return std::vector<Beam>{{box.center(), 0.5, box.center(), 0.5}};
    };
    CHECK(slabs.at(0, left, 0.5, query).beams.size() == 1);
}

}  // namespace piece_slabs_test
