// Lattices of struts against closed forms and brute force; one piece across sizes; slabs that join.
#include "procedural/lattice/strut_lattice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "engine/base/error.h"
#include "procedural/foam/beam_box.h"
#include "tests/engine/field/gradings.h"

namespace strut_lattice_test {

using namespace lamella;

namespace {

const char* const names[] = {"cubic", "bcc", "fcc", "octet"};

LatticeSettings settings(const char* name, GradingPtr cell, GradingPtr beam, Box region) {
    LatticeSettings s;
    s.struts = unit_cell(name);
    s.cell = std::move(cell);
    s.beam = std::move(beam);
    s.region = region;
    return s;
}

LatticeSettings constant(const char* name, double cell, double beam, Box region = {dvec3(0), dvec3(6)}) {
    return settings(name, make_constant_grading(cell), make_constant_grading(beam), region);
}

/// Cells of 4, 2 and 1 mm.
LatticeSettings graded(const char* name) {
    return settings(name, std::make_shared<Linear>(1, dvec3(3.0 / 16, 0, 0)),
                    std::make_shared<Linear>(0.1, dvec3(0.015, 0, 0)), {dvec3(0), {16, 8, 8}});
}

dvec3 random_point(std::mt19937& random, const Box& box) {
    std::uniform_real_distribution<double> unit(0, 1);
    return box.lo + box.size() * dvec3(unit(random), unit(random), unit(random));
}

double nearest(const std::vector<Beam>& beams, dvec3 p) {
    double least = infinity;
    for (const Beam& beam : beams) least = std::min(least, signed_distance(beam, p));
    return least;
}

/// All struts of all cells that meet the box, straight from the unit cell, shared ones as often as they come.
std::vector<Beam> plain_beams(const std::vector<Strut>& struts, const StrutLattice& lattice, const Box& box,
                              const Grading& radius) {
    std::vector<Beam> beams;
    lattice.cells().for_each(box, [&](const OctreeCell& cell) {
        const Box cube = lattice.cells().box(cell);
        const Box& graded_in = lattice.bounds();
        const auto radius_at = [&](dvec3 p) { return radius.at(glm::clamp(p, graded_in.lo, graded_in.hi)); };
        for (const Strut& s : struts) {
            const dvec3 a = cube.lo + s.a * cube.size(), b = cube.lo + s.b * cube.size();
            beams.push_back({a, radius_at(a), b, radius_at(b)});
        }
    });
    return beams;
}

auto key(const Beam& b) { return std::make_tuple(b.a.z, b.a.y, b.a.x, b.b.z, b.b.y, b.b.x); }

std::vector<Beam> sorted(std::vector<Beam> beams) {
    std::sort(beams.begin(), beams.end(), [](const Beam& s, const Beam& t) { return key(s) < key(t); });
    return beams;
}

int pieces(const std::vector<Beam>& beams) {
    std::map<std::tuple<double, double, double>, std::size_t> nodes;
    std::vector<std::size_t> parent;
    const auto node = [&](dvec3 p) {
        const auto [place, fresh] = nodes.try_emplace({p.x, p.y, p.z}, parent.size());
        if (fresh) parent.push_back(parent.size());
        return place->second;
    };
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Beam& beam : beams) {
        const std::size_t a = root(node(beam.a)), b = root(node(beam.b));
        parent[a] = b;
    }
    int count = 0;
    for (std::size_t i = 0; i < parent.size(); ++i) count += parent[i] == i;
    return count;
}

}  // namespace

TEST_CASE("a cubic lattice's value is the distance to three families of lines", "[strut_lattice]") {
    const double cell = 1.3, radius = 0.21;
    const Box region{{0.2, -0.4, 0.1}, {6, 6, 6}};
    const StrutLattice lattice(constant("cubic", cell, radius, region));
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const dvec3 p = random_point(random, grown(region, 5));
        dvec3 d = (p - region.lo) / cell;
        d = (d - glm::floor(d + 0.5)) * cell;
        const dvec3 s = d * d;
        const double expected = std::sqrt(std::min(s.y + s.z, std::min(s.x + s.z, s.x + s.y))) - radius;
        REQUIRE(lattice.value(p) == Approx(expected).margin(1e-9));
    }
    CHECK(std::isnan(lattice.value({std::nan(""), 0, 0})));
    CHECK(std::isnan(lattice.value({0, infinity, 0})));
    CHECK(std::isnan(lattice.value({0, 1e10, 0})));
}

TEST_CASE("a cell owns each strut once", "[strut_lattice]") {
    const std::size_t expected[] = {3, 8, 12, 24};
    for (std::size_t i = 0; i < 4; ++i) {
        INFO(names[i]);
        const StrutLattice lattice(constant(names[i], 2, 0.1));
        // Struts whose middle lies in one half-open cell.
        std::size_t count = 0;
        for (const Beam& beam : lattice.beams_touching({dvec3(1), dvec3(5)})) {
            const dvec3 m = (beam.a + beam.b) * 0.5;
            count += m.x >= 2 && m.x < 4 && m.y >= 2 && m.y < 4 && m.z >= 2 && m.z < 4;
        }
        CHECK(count == expected[i]);
    }
}

TEST_CASE("the value is the distance to the nearest of all beams of all cells", "[strut_lattice]") {
    std::mt19937 random(3);
    for (const char* name : names) {
        for (const LatticeSettings& s : {graded(name), constant(name, 1.7, 0.2)}) {
            const StrutLattice lattice(s);
            const auto all = plain_beams(s.struts, lattice, grown(s.region, 5), *s.beam);
            for (int i = 0; i < 120; ++i) {
                const dvec3 p = random_point(random, grown(s.region, 1));
                INFO(name << " at " << p.x << " " << p.y << " " << p.z);
                REQUIRE(lattice.value(p) == Approx(nearest(all, p)).margin(1e-9));
            }
        }
    }
}

TEST_CASE("the beams that touch a box are those of all cells, each once, in one order", "[strut_lattice]") {
    std::mt19937 random(5);
    for (const char* name : names) {
        for (const LatticeSettings& s : {graded(name), constant(name, 1.7, 0.2)}) {
            const StrutLattice lattice(s);
            const auto all = lattice.beams_touching(grown(s.region, 3));
            const auto plain = plain_beams(s.struts, lattice, grown(s.region, 4), *s.beam);
            for (int i = 0; i < 25; ++i) {
                const dvec3 p = random_point(random, s.region), q = random_point(random, s.region);
                const Box box{glm::min(p, q), glm::max(p, q)};
                INFO(name);
                const auto found = lattice.beams_touching(box);
                std::vector<Beam> expected;
                for (const Beam& beam : all) {
                    if (touches(beam, box)) expected.push_back(beam);
                }
                REQUIRE(found == expected);
                std::vector<Beam> brute;
                for (Beam beam : plain) {
                    if (!touches(beam, box)) continue;
                    if (std::make_tuple(beam.b.z, beam.b.y, beam.b.x) <
                        std::make_tuple(beam.a.z, beam.a.y, beam.a.x)) {
                        std::swap(beam.a, beam.b);
                        std::swap(beam.ra, beam.rb);
                    }
                    brute.push_back(beam);
                }
                brute = sorted(brute);
                // Equal struts of neighbouring cells differ by rounding at most.
                const auto same = [](const Beam& t, const Beam& u) {
                    return glm::length(t.a - u.a) + glm::length(t.b - u.b) < 1e-9;
                };
                std::vector<Beam> once;
                for (const Beam& beam : brute) {
                    if (std::none_of(once.begin(), once.end(),
                                     [&](const Beam& b) { return same(b, beam); })) {
                        once.push_back(beam);
                    }
                }
                REQUIRE(found.size() == once.size());
            }
        }
    }
}

TEST_CASE("slabs' beams together are the whole's", "[strut_lattice]") {
    for (const char* name : names) {
        INFO(name);
        const LatticeSettings s = graded(name);
        const StrutLattice lattice(s), other(s);
        const auto whole = sorted(lattice.beams_touching(s.region));
        std::vector<Beam> joined;
        for (int i = 7; i >= 0; --i) {
            Box slab = s.region;
            slab.lo.z = i;
            slab.hi.z = i + 1;
            const auto beams = other.beams_touching(slab);
            joined.insert(joined.end(), beams.begin(), beams.end());
        }
        joined = sorted(joined);
        joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
        CHECK(joined == whole);
    }
}

TEST_CASE("a lattice hangs together across sizes of cells", "[strut_lattice]") {
    for (const char* name : names) {
        const auto step = settings(name, std::make_shared<Step>(9, 0.5, 4), make_constant_grading(0.1),
                                   {dvec3(0), {16, 8, 8}});
        for (const LatticeSettings& s : {graded(name), step, constant(name, 2, 0.2)}) {
            const StrutLattice lattice(s);
            const auto beams = lattice.beams_touching(grown(s.region, -0.5));
            double shortest = infinity, longest = 0;
            for (const Beam& beam : beams) {
                shortest = std::min(shortest, glm::length(beam.b - beam.a));
                longest = std::max(longest, glm::length(beam.b - beam.a));
            }
            INFO(name << ", " << beams.size() << " beams from " << shortest << " to " << longest << " mm");
            CHECK(beams.size() > 30);
            CHECK((longest > 3.9 * shortest) == (lattice.cells().levels() > 0));
            CHECK(pieces(beams) == 1);
        }
    }
}

TEST_CASE("a beam is split where the radius bends", "[strut_lattice]") {
    class Bowl : public Grading {
      public:
        double at(dvec3 p) const override { return 0.05 + 0.02 * p.x * p.x; }
        Interval range(const Box& box) const override {
            const double a = box.lo.x * box.lo.x, b = box.hi.x * box.hi.x;
            return {0.05 + (box.lo.x * box.hi.x < 0 ? 0 : 0.02 * std::min(a, b)),
                    0.05 + 0.02 * std::max(a, b)};
        }
    };
    const Box region{{-3, -3, -3}, {3, 3, 3}};
    const auto radius = std::make_shared<Bowl>();
    const StrutLattice bent(settings("cubic", make_constant_grading(1.5), radius, region));
    const auto beams = bent.beams_touching(region);
    std::size_t parts = 0;
    for (const Beam& beam : beams) {
        parts += glm::length(beam.b - beam.a) < 1.4;
        for (int k = 1; k < 16; ++k) {
            const double t = k / 16.0;
            const dvec3 p = beam.a + (beam.b - beam.a) * t;
            const double expected = radius->at(glm::clamp(p, region.lo, region.hi));
            REQUIRE(beam.ra + (beam.rb - beam.ra) * t == Approx(expected).epsilon(0.021));
        }
    }
    CHECK(parts > 0);
    CHECK(pieces(beams) == 1);
    std::mt19937 random(9);
    for (int i = 0; i < 500; ++i) {
        const dvec3 p = random_point(random, grown(region, -0.8));
        REQUIRE(bent.value(p) == Approx(nearest(beams, p)).margin(1e-12));
    }
}

TEST_CASE("an offset lattice has thicker beams", "[strut_lattice]") {
    const LatticeSettings s = graded("bcc");
    const auto lattice = make_strut_lattice(s);
    const auto thicker = lattice->offset(0.13);
    CHECK(lattice->offset(-0.01) == nullptr);
    CHECK(thicker->bounds().lo.x == -0.13);
    std::mt19937 random(7);
    for (int i = 0; i < 500; ++i) {
        const dvec3 p = random_point(random, s.region);
        REQUIRE(thicker->value(p) == Approx(lattice->value(p) - 0.13).margin(1e-9));
    }
}

TEST_CASE("a lattice out of range is refused", "[strut_lattice]") {
    REQUIRE_THROWS_WITH(unit_cell("diamond"), Catch::Contains("accepted: cubic, bcc, fcc, octet"));
    const auto with = [](std::vector<Strut> struts) {
        LatticeSettings s = constant("bcc", 2, 0.2);
        s.struts = std::move(struts);
        return s;
    };
    REQUIRE_THROWS_AS(StrutLattice(with({})), InputError);
    REQUIRE_THROWS_AS(StrutLattice(with({{dvec3(0.5), dvec3(0.5)}})), InputError);
    REQUIRE_THROWS_AS(StrutLattice(with({{dvec3(0.5), dvec3(1.5)}})), InputError);
    REQUIRE_THROWS_AS(StrutLattice(with({{dvec3(0.5), dvec3(std::nan(""))}})), InputError);
    REQUIRE_THROWS_AS(StrutLattice(with(std::vector<Strut>(65, {dvec3(0), dvec3(1)}))), InputError);
    REQUIRE_NOTHROW(StrutLattice(with({{dvec3(0.2), dvec3(0.7)}})));
    REQUIRE_THROWS_AS(StrutLattice(constant("bcc", 2, 0)), InputError);
    REQUIRE_THROWS_AS(StrutLattice(constant("bcc", 2, 1)), InputError);
    REQUIRE_THROWS_AS(StrutLattice(constant("bcc", 0, 1)), InputError);
    REQUIRE_THROWS_AS(StrutLattice(constant("bcc", 1e-4, 1e-5)), InputError);
    REQUIRE_THROWS_AS(StrutLattice(constant("bcc", 2, 0.2, {})), InputError);
    REQUIRE_THROWS_AS(StrutLattice(constant("bcc", 2, 0.2, {dvec3(0), dvec3(infinity)})), InputError);
    LatticeSettings s = constant("bcc", 2, 0.2);
    s.beam = std::make_shared<Undefined>();
    REQUIRE_THROWS_AS(StrutLattice(s), InputError);
    s.beam = nullptr;
    REQUIRE_THROWS_AS(StrutLattice(s), InputError);
}

}  // namespace strut_lattice_test
