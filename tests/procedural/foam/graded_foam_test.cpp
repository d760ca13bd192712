// Foams whose cells and beams vary in space: exact against brute force, pure, tapered, and counted right.
#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "procedural/foam/beam_box.h"
#include "procedural/foam/plane_strips.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/voronoi/counter_hash.h"
#include "procedural/voronoi/graded_density.h"
#include "tests/engine/field/gradings.h"
#include "tests/procedural/voronoi/brute_voronoi.h"

namespace graded_foam_test {

using namespace lamella;

namespace {

using GradingOf = std::shared_ptr<const Grading>;

FoamSettings settings(GradingOf cell, Graded beam, const Box& region, std::uint64_t seed = 3) {
    FoamSettings s;
    s.cell = std::move(cell);
    s.beam_radius = std::move(beam);
    s.region = region;
    s.seed = seed;
    return s;
}

dvec3 random_point(const Box& box, std::int64_t i) {
    const CounterHash hash(29, 0, i, 0, 0);
    return box.lo + box.size() * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2));
}

/// A grading of the sample's own: ramps, steps and cones by turns, over a factor of up to 10.
GradingOf random_cells(std::int64_t sample) {
    const CounterHash hash(31, 0, sample, 0, 0);
    const double lo = 0.5 + 0.5 * hash.uniform(0), hi = lo * (1 + 9 * hash.uniform(1) * hash.uniform(4)),
                 at = hash.uniform(2);
    if (sample % 3 == 0) return std::make_shared<const Ramp>(-2 + at, lo, 3 + 4 * at, hi);
    if (sample % 3 == 1) return std::make_shared<const Step>(at, at < 0.5 ? lo : hi, at < 0.5 ? hi : lo);
    return std::make_shared<const Cone>(dvec3(at, 0.3, 0.6), lo, 0.4 * hash.uniform(3));
}

/// The distance from points of a lattice over the box to their nearest seed.
struct Gaps {
    static constexpr int n = 8;
    std::vector<dvec3> points;
    std::vector<double> nearest;
    double step;

    Gaps(const std::vector<Seed>& seeds, const Box& box) : step(glm::length(box.size()) / (n - 1)) {
        for (int i = 0; i < n * n * n; ++i) {
            points.push_back(box.lo + box.size() * dvec3(i % n, i / n % n, i / n / n) / (n - 1.0));
            double least = infinity;
            for (const Seed& seed : seeds)
                least = std::min(least, glm::distance(seed.position, points.back()));
            nearest.push_back(least);
        }
    }
    /// No point of the box is farther than this from a seed.
    double largest() const { return *std::max_element(nearest.begin(), nearest.end()) + step / 2; }
    /// Whether a cell about the seed can reach the box: distances change by at most 1 per mm.
    bool reached_from(dvec3 seed) const {
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (glm::distance(seed, points[i]) <= nearest[i] + step) return true;
        }
        return false;
    }
};

/// The edges of the inner seeds, clipped by seeds within a margin of the box, which grows until no seed
/// beyond it can matter: what ends an edge lies no farther from its end than the edge's own seeds.
std::vector<VoronoiEdge> edges_of(const VoronoiFoam& foam, const std::vector<dvec3>& inner, const Box& box,
                                  double margin) {
    for (;;) {
        const auto edges = brute_voronoi_edges(foam.seeds_in(grown(box, margin)), inner, box.center());
        double needed = 0;
        for (const auto& [from, to] : edges) {
            for (const dvec3 end : {from, to}) {
                double nearest = infinity;
                for (const dvec3 seed : inner) nearest = std::min(nearest, glm::distance(seed, end));
                needed = std::max(needed, distance(box, end) + nearest);
            }
        }
        if (needed <= margin) return edges;
        margin = needed * 1.01;
    }
}

bool same_place(const Beam& beam, const VoronoiEdge& s) {
    const auto near = [](dvec3 p, dvec3 q) { return glm::distance(p, q) < 1e-7; };
    return (near(beam.a, s.first) && near(beam.b, s.second)) ||
           (near(beam.a, s.second) && near(beam.b, s.first));
}

}  // namespace

TEST_CASE("in 50 graded boxes the beams are those found by brute force", "[graded_foam]") {
    constexpr double radius = 0.04;
    std::size_t compared = 0;
    for (std::int64_t sample = 0; sample < 50; ++sample) {
        INFO("sample " << sample);
        const VoronoiFoam foam(settings(random_cells(sample), radius, {dvec3(-3), dvec3(4)},
                                        static_cast<std::uint64_t>(sample)));
        const dvec3 corner = random_point({dvec3(0), dvec3(0.8)}, sample);
        Box box{corner, corner + foam.cells().hi * random_point({dvec3(0.3), dvec3(1)}, sample + 99)};
        // Edges that touch the box have their seeds among those whose cells reach it; brute force wants few.
        std::vector<dvec3> inner;
        double reach = 0;
        for (;; box.hi = box.center()) {
            const double margin = 2 * foam.cells().hi;
            const auto about = foam.seeds_in(grown(box, margin));
            const Gaps gaps(about, grown(box, radius));
            reach = gaps.largest();
            REQUIRE(reach < margin);
            inner.clear();
            for (const Seed& seed : about) {
                if (gaps.reached_from(seed.position)) inner.push_back(seed.position);
            }
            if (inner.size() <= 60) break;
        }
        std::vector<VoronoiEdge> expected;
        for (const VoronoiEdge& s : edges_of(foam, inner, box, 2 * reach)) {
            if (touches(Beam{s.first, radius, s.second, radius}, box)) expected.push_back(s);
        }
        const auto beams = foam.beams_touching(box);
        CHECK(beams.size() == expected.size());
        for (const VoronoiEdge& s : expected) {
            CHECK(std::count_if(beams.begin(), beams.end(),
                                [&](const Beam& b) { return same_place(b, s); }) == 1);
        }
        compared += expected.size();
    }
    CHECK(compared > 500);
}

TEST_CASE("seeds are as many as the density's integral, over a factor of 1,000", "[graded_foam]") {
    // Cells from 0.5 mm to 5 mm: one seed per (0.5 + 0.1125 x)^3 in slabs across x.
    const auto cell = std::make_shared<const Ramp>(0, 0.5, 40, 5);
    const VoronoiFoam foam(settings(cell, 0.05, {{0, 0, 0}, {40, 20, 20}}));
    const double slope = 4.5 / 40;
    const auto integral = [&](double x0, double x1) {
        const double a = 0.5 + slope * x0, b = 0.5 + slope * x1;
        return 400 * (1 / (a * a) - 1 / (b * b)) / (2 * slope);
    };
    for (const auto& [x0, x1] :
         {std::pair(0.0, 2.0), std::pair(2.0, 5.0), std::pair(5.0, 15.0), std::pair(15.0, 40.0)}) {
        const auto seeds = foam.seeds_in({{x0, 0, 0}, {x1, 20, 20}});
        const double expected = integral(x0, x1);
        INFO("from " << x0 << " to " << x1 << ": " << seeds.size() << " of " << expected);
        // A stratified count varies less than a Poisson count.
        CHECK(std::abs(static_cast<double>(seeds.size()) - expected) <
              3 * std::sqrt(expected) + 0.01 * expected);
    }
}

TEST_CASE("seeds show no seam at the borders of coarse cells", "[graded_foam]") {
    // Where along its coarse cell of 4 mm each seed lies, in sixteenths: as many in each as the density says.
    const auto cell = std::make_shared<const Ramp>(0, 0.4, 64, 2);
    const VoronoiFoam foam(settings(cell, 0.02, {{0, 0, 0}, {64, 16, 16}}));
    for (int axis = 1; axis < 3; ++axis) {
        std::array<double, 16> histogram{};
        const auto seeds = foam.seeds_in({{0, 0, 0}, {64, 16, 16}});
        for (const Seed& seed : seeds) {
            histogram[static_cast<std::size_t>(std::floor(seed.position[axis] * 4)) % 16] += 1;
        }
        const double mean = static_cast<double>(seeds.size()) / 16;
        double chi_squared = 0;
        for (const double count : histogram) chi_squared += (count - mean) * (count - mean) / mean;
        INFO("axis " << axis << ", mean " << mean);
        CHECK(chi_squared < 30.6);  // 1 % of chi squared with 15 degrees of freedom
    }
}

TEST_CASE("every coarse cell has a seed, however sharp the jump", "[graded_foam]") {
    const SeedTree tree(std::make_shared<const GradedDensity>(std::make_shared<const Step>(3.3, 10, 1)), 20,
                        4);
    for (std::int64_t i = 0; i < 64; ++i) {
        CHECK(!tree.block({i % 4 - 2, i / 4 % 4 - 2, i / 16 - 2})->positions.empty());
    }
}

TEST_CASE("the graded foam's value is the distance to the nearest of all beams", "[graded_foam]") {
    const auto cell = std::make_shared<const Step>(1.1, 0.5, 4);
    const auto beam = std::make_shared<const Ramp>(-4, 0.05, 6, 0.6);
    const VoronoiFoam foam(settings(cell, GradingPtr(beam), {dvec3(-4), dvec3(6)}));
    const Box box{{0.4, 0, 0}, {2.4, 1, 1}};
    const auto beams = foam.beams_touching(grown(box, 2.5));
    for (int i = 0; i < 500; ++i) {
        const dvec3 p = random_point(box, i);
        double expected = infinity;
        for (const Beam& b : beams) expected = std::min(expected, signed_distance(b, p));
        REQUIRE(foam.value(p) == expected);
    }
}

TEST_CASE("slabs hold the beams of the whole, in any order of asking", "[graded_foam]") {
    const auto cell = std::make_shared<const Cone>(dvec3(2, 2, 5), 0.6, 0.5);
    const FoamSettings s =
        settings(cell, GradingPtr(std::make_shared<const Ramp>(0, 0.05, 8, 0.3)), {dvec3(0), dvec3(8)});
    const VoronoiFoam whole(s), slabs(s);
    const auto less = [](const Beam& a, const Beam& b) {
        return std::tie(a.a.x, a.a.y, a.a.z, a.b.x, a.b.y, a.b.z) <
               std::tie(b.a.x, b.a.y, b.a.z, b.b.x, b.b.y, b.b.z);
    };
    auto all = whole.beams_touching({dvec3(0), dvec3(8)});
    std::vector<Beam> joined;
    for (int i = 15; i >= 0; --i) {
        const Box slab{{0, 0, i * 0.5}, {8, 8, i * 0.5 + 0.5}};
        const auto part = slabs.beams_touching(slab);
        joined.insert(joined.end(), part.begin(), part.end());
    }
    std::sort(all.begin(), all.end(), less);
    std::sort(joined.begin(), joined.end(), less);
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    CHECK(all.size() > 300);
    CHECK(joined == all);
}

TEST_CASE("beams take their radius at their ends and stay within 2 % of it between", "[graded_foam]") {
    const auto beam = std::make_shared<const Cone>(dvec3(5, 5, 5), 0.1, 0.06);
    const VoronoiFoam foam(
        settings(std::make_shared<const Ramp>(0, 2, 10, 4), GradingPtr(beam), {dvec3(0), dvec3(10)}));
    const auto beams = foam.beams_touching({dvec3(1), dvec3(9)});
    int tapered = 0;
    for (const Beam& b : beams) {
        CHECK(b.ra == beam->at(b.a));
        CHECK(b.rb == beam->at(b.b));
        tapered += std::abs(b.ra - b.rb) > 0.02;
        for (int i = 1; i < 8; ++i) {
            const double t = i / 8.0, asked = beam->at(b.a + (b.b - b.a) * t);
            CHECK(std::abs(b.ra + (b.rb - b.ra) * t - asked) < 0.025 * asked);
        }
    }
    CHECK(tapered > 20);
}

TEST_CASE("beams leave an opening in cells too small for them", "[graded_foam]") {
    const auto cell = std::make_shared<const Ramp>(0, 1, 10, 4);
    const VoronoiFoam foam(settings(cell, 0.9, {dvec3(0), dvec3(10)}));
    for (const Beam& b : foam.beams_touching({dvec3(0), dvec3(10)})) {
        CHECK(b.ra == std::min(0.9, 0.45 * cell->at(b.a)));
    }
}

TEST_CASE("strips give the runs of the undivided plane", "[graded_foam]") {
    const auto cell = std::make_shared<const Ramp>(0, 0.8, 12, 2.5);
    const VoronoiFoam foam(settings(cell, 0.15, {dvec3(0), dvec3(12)}));
    const auto query = [&](std::size_t, const Rect& rect) {
        return PlanePieces{foam.beams_touching({dvec3(rect.lo, 4.3), dvec3(rect.hi, 4.3)}), {}};
    };
    const PlaneStrips whole(foam, query, foam.bounds().rect(), 1, 4.3),
        cut(foam, query, foam.bounds().rect(), 7, 4.3);
    Scratch scratch;
    RunRows expected, found;
    for (const Axis axis : {Axis::x, Axis::y}) {
        RowBand band{axis, 0, 0.05, 0, 0.05, 30, 150, 2, 0, 240};
        whole.runs(band, scratch, expected);
        cut.runs(band, scratch, found);
        CHECK(std::equal(expected.runs().begin(), expected.runs().end(), found.runs().begin(),
                         found.runs().end()));
        CHECK(expected.runs().size() > 1000);
    }
}

TEST_CASE("a stretched foam is the round one with its nodes moved", "[graded_foam]") {
    FoamSettings round =
        settings(std::make_shared<const Ramp>(-50, 1.0, 60, 1.0), 0.1, {dvec3(-20), dvec3(20)});
    round.cell = 1.5;
    FoamSettings stretched = round;
    stretched.stretch = Stretch(turned_axes({0, 0, 30}), {2, 1, 0.5});
    const VoronoiFoam a(round), b(stretched);
    const Box box{dvec3(-2), dvec3(2)};
    const auto beams = b.beams_touching(box);
    std::vector<Beam> expected;
    for (Beam beam : a.beams_touching(grown(box, 6))) {
        beam.a = stretched.stretch.to_part(beam.a);
        beam.b = stretched.stretch.to_part(beam.b);
        if (touches(beam, box)) expected.push_back(beam);
    }
    CHECK(beams.size() > 100);
    CHECK(beams.size() == expected.size());
    for (const Beam& beam : expected) CHECK(std::count(beams.begin(), beams.end(), beam) == 1);
}

TEST_CASE("seeds on a bcc pattern make truncated octahedra", "[graded_foam]") {
    FoamSettings kelvin = settings(std::make_shared<const Ramp>(0, 1, 1, 1), 0.05, {dvec3(0), dvec3(12)});
    kelvin.cell = 2.0;
    kelvin.pattern = SeedPattern::bcc;
    kelvin.jitter = 0;
    const VoronoiFoam foam(kelvin);
    // The edge of a truncated octahedron of volume v is (v / (8 sqrt 2))^(1/3).
    const double edge = std::cbrt(8.0 / (8 * std::sqrt(2.0)));
    const auto beams = foam.beams_touching({dvec3(2), dvec3(10)});
    CHECK(beams.size() > 300);
    for (const Beam& beam : beams) CHECK(glm::distance(beam.a, beam.b) == Approx(edge).epsilon(1e-9));
    const auto seeds = foam.seeds_in({dvec3(0), dvec3(20 * std::cbrt(2.0))});
    CHECK(seeds.size() == 2000);
}

TEST_CASE("graded settings that make no foam are refused", "[graded_foam]") {
    const Box region{dvec3(0), dvec3(10)};
    const auto ramp = [](double lo, double hi) { return std::make_shared<const Ramp>(0, lo, 10, hi); };
    CHECK_THROWS_WITH(VoronoiFoam(settings(ramp(-1, 2), 0.1, region)),
                      Catch::Contains("cell size goes down to -1 mm"));
    CHECK_THROWS_WITH(VoronoiFoam(settings(ramp(0.01, 2), 0.1, region)),
                      Catch::Contains("at most") || Catch::Contains("40 times"));
    CHECK_THROWS_WITH(VoronoiFoam(settings(ramp(1, 2), GradingPtr(ramp(0, 1)), region)),
                      Catch::Contains("beam radius goes down to 0 mm"));
    CHECK_THROWS_AS(VoronoiFoam(settings(ramp(1, std::nan("")), 0.1, region)), InputError);
}

}  // namespace graded_foam_test
