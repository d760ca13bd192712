// Regions in built parts: solids against closed forms, one foam across a border, and keep-out zones.
#include "recipe/build/build_regions.h"

#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <thread>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/app/commands/recipes.h"
#include "tests/engine/runs/plane_runs.h"

namespace build_regions_test {

using namespace lamella;

namespace {

const std::string block =
    "[part]\nshape = \"box\"\nsize = [24, 20, 12]\n"
    "[[field]]\nname = \"ball\"\nkind = \"sphere\"\nradius = 4\nat = [2, 1, 0]\n"
    "[[field]]\nname = \"shaft\"\nkind = \"cylinder\"\nradius = 2\nheight = 40\nat = [2, 1, 0]\nturn = [0, "
    "20, 0]\n"
    "[[field]]\nname = \"half\"\nformula = \"2*x\"\n"
    "[foam]\ncell = 2.4\nbeam = 0.25\n";
const std::string skin = "[skin]\nthickness = 0.7\n";

BuiltJob build(const std::string& text) { return build_job(recipe_of(block + text)); }

std::string region(const std::string& field, const std::string& rest) {
    return "[[region]]\nfield = \"" + field + "\"\nmake = " + rest + "\n";
}

const FieldPtr ball = make_sphere({2, 1, 0}, 4);

/// Runs of several layers of the part.
std::vector<RunRows> layers(const BuiltJob& built, double pitch) {
    std::vector<RunRows> all;
    for (double z = -5.9; z < 6; z += 0.83)
        all.push_back(runs_at(*built.job.part, z, band_over(built.job.bounds, pitch)));
    return all;
}

/// Sine of the angle by which two beams that meet at a place miss being one straight one.
double bend(const std::vector<Beam>& beams, const std::vector<std::size_t>& meeting, dvec3 at) {
    const auto away = [&](std::size_t i) {
        return glm::normalize((beams[i].a == at ? beams[i].b : beams[i].a) - at);
    };
    return glm::length(away(meeting[0]) + away(meeting[1]));
}

}  // namespace

TEST_CASE("a solid region adds the volume of its ball less the foam that was in it") {
    const BuiltJob with = build(region("ball", "\"solid\"")), without = build("");
    const Box box = with.job.bounds;
    constexpr double pitch = 0.08;
    const double in_ball = volume_in(*make_intersection({without.job.part, ball}), box, pitch);
    const double added = volume_in(*with.job.part, box, pitch) - volume_in(*without.job.part, box, pitch);
    const double whole = 4.0 / 3 * std::numbers::pi * 64;
    CHECK(added + in_ball == Approx(whole).epsilon(1e-3));
    CHECK(in_ball < 0.3 * whole);
}

TEST_CASE("a solid region is solid to its surface, stays within the body, and leaves the rest as it was") {
    // The ball of radius 4 at height 3 reaches out of the top at 6.
    const std::string high = "[[field]]\nname = \"high\"\nkind = \"sphere\"\nradius = 4\nat = [2, 1, 3]\n";
    for (const std::string blend : {"0", "1.5"}) {
        const BuiltJob with = build(high + skin + region("high", "\"solid\"\nblend = " + blend));
        const BuiltJob without = build(skin);
        const FieldPtr high_ball = make_sphere({2, 1, 3}, 4),
                       reach = make_sphere({2, 1, 3}, 4 + std::stod(blend));
        CHECK(with.job.bounds.hi.z == 6);
        const RowBand band = band_over(grown(with.job.bounds, 2), 0.06);
        for (double z = -5.9; z < 7.5; z += 0.61) {
            const RunRows part = runs_at(*with.job.part, z, band), body = runs_at(*with.body, z, band);
            RunRows in_body, missing, beyond, rest, before;
            intersect(runs_at(*high_ball, z, band), body, in_body);
            subtract(in_body, part, missing);
            CHECK(missing.runs().empty());
            subtract(part, body, beyond);
            CHECK(beyond.runs().empty());
            const RunRows near = runs_at(*reach, z, band);
            subtract(part, near, rest);
            subtract(runs_at(*without.job.part, z, band), near, before);
            CHECK(rest == before);
        }
    }
}

TEST_CASE("a keep-out zone is void and leaves what is farther than its blend byte for byte") {
    for (const double blend : {0.0, 0.8}) {
        const BuiltJob with = build(skin + region("shaft", "\"empty\"\nblend = " + std::to_string(blend)));
        const BuiltJob without = build(skin);
        const dvec3 tilt(std::sin(20 * std::numbers::pi / 180), 0, std::cos(20 * std::numbers::pi / 180));
        const auto shaft = [&](double more) {
            return make_cylinder(dvec3(2, 1, 0) - 30.0 * tilt, dvec3(2, 1, 0) + 30.0 * tilt, 2 + more);
        };
        const RowBand band = band_over(with.job.bounds, 0.06);
        int touched = 0;
        for (double z = -5.9; z < 6; z += 0.61) {
            const RunRows part = runs_at(*with.job.part, z, band), old = runs_at(*without.job.part, z, band);
            RunRows inside, rest, before;
            intersect(part, runs_at(*shaft(-1e-4), z, band), inside);
            CHECK(inside.runs().empty());
            const RunRows near = runs_at(*shaft(blend + 1e-4), z, band);
            subtract(part, near, rest);
            subtract(old, near, before);
            CHECK(rest == before);
            touched += !(part == old);
        }
        CHECK(touched > 10);
    }
}

TEST_CASE("numbers of a region of foam hold exactly inside it, and those of the part outside") {
    const BuiltJob built = build(region("ball", "\"foam\"\ncell = 1.3\nbeam = \"cell/9\"\nblend = 2"));
    const Grading& cell = *built.foam->cell.made;
    const Grading& beam = *built.foam->member.made;
    CHECK(cell.at({2, 1, 0}) == 1.3);
    CHECK(cell.at({2 + 2.99, 1, 0}) == 1.3);
    CHECK(cell.at({2 + 5.01, 1, 0}) == 2.4);
    CHECK(cell.at({-11, -9, 5}) == 2.4);
    CHECK(beam.at({2, 1, 0}) == 1.3 / 9);
    CHECK(beam.at({-11, -9, 5}) == 0.25);
    double before = 0;
    for (double x = 2; x < 11; x += 1e-3) {
        const double now = cell.at({x, 1, 0});
        if (before > 0) REQUIRE((now >= before && now - before < 1.1 * 1.5 / 2 * 1e-3 * 1.01));
        before = now;
    }
}

TEST_CASE("a region of foam has the cells that it asks for") {
    const BuiltJob built = build(region("half", "\"foam\"\ncell = 1.2\nblend = 2"));
    const auto cells_of = [&](const Box& box) {
        const dvec3 size = box.size();
        return std::cbrt(size.x * size.y * size.z / static_cast<double>(built.foam->seeds_in(box).size()));
    };
    // One seed to every cell cubed: hundreds of them are known to a per cent.
    CHECK(cells_of({{-12, -10, -6}, {-1.5, 10, 6}}) == Approx(1.2).epsilon(0.02));
    CHECK(cells_of({{1.5, -10, -6}, {12, 10, 6}}) == Approx(2.4).epsilon(0.04));
}

TEST_CASE("the foam is one network across the border of a region") {
    for (const std::string blend : {"0", "3"}) {
        const BuiltJob built = build(region("half", "\"foam\"\ncell = 1.2\nbeam = 0.12\nblend = " + blend));
        // Beams that reach out of the box may end alone there.
        const Box box{{-5, -8, -5}, {5, 8, 5}};
        const std::vector<Beam> beams = built.foam->beams_touching(grown(box, 2));
        using Place = std::tuple<double, double, double>;
        std::map<Place, std::vector<std::size_t>> ends;
        const auto place = [](dvec3 p) { return Place{p.x, p.y, p.z}; };
        for (std::size_t i = 0; i < beams.size(); ++i) {
            ends[place(beams[i].a)].push_back(i);
            ends[place(beams[i].b)].push_back(i);
        }
        std::vector<std::size_t> root(beams.size());
        std::iota(root.begin(), root.end(), std::size_t{0});
        const auto find = [&](std::size_t i) {
            while (root[i] != i) i = root[i] = root[root[i]];
            return i;
        };
        for (const auto& [at, meeting] : ends) {
            for (const std::size_t i : meeting) root[find(i)] = find(meeting.front());
        }
        std::size_t inside = 0, network = 0;
        for (const auto& [at, meeting] : ends) {
            const dvec3 p(std::get<0>(at), std::get<1>(at), std::get<2>(at));
            if (!box.contains(p)) continue;
            // Four cells meet in a vertex, and so do four edges; two beams meet where an edge is divided
            // because its radius changes.
            REQUIRE((meeting.size() == 2 || meeting.size() >= 4));
            if (meeting.size() == 2) REQUIRE(bend(beams, meeting, p) < 1e-6);
            if (inside++ == 0) network = find(meeting.front());
            REQUIRE(find(meeting.front()) == network);
        }
        CHECK(inside > 2000);
    }
}

TEST_CASE("a region of skin has the thickness that it asks for, none where that is 0, and blends between") {
    const BuiltJob built = build(skin + region("half", "\"skin\"\nthickness = 0\nblend = 4"));
    const auto skin_at = [&](double x) {
        // Where the foam does not reach the surface, the material under it is the skin.
        double least = 12;
        for (double y = -8; y < 8; y += 0.37) {
            double depth = 0;
            while (depth < 12 && built.job.part->value({x, y, 6 - depth - 1e-6}) < 0) depth += 0.005;
            least = std::min(least, depth);
        }
        return least;
    };
    CHECK(skin_at(-9) == Approx(0).margin(0.006));
    CHECK(skin_at(0) == Approx(0.35).margin(0.02));
    CHECK(skin_at(9) == Approx(0.7).margin(0.006));
    CHECK(skin_at(1) > skin_at(0));
    CHECK(skin_at(-1) < skin_at(0));
}

TEST_CASE("a region of skin gives a skin to a part that has none") {
    const BuiltJob built = build(region("half", "\"skin\"\nthickness = 1"));
    const BuiltJob bare = build("");
    int more = 0;
    for (double y = -9.5; y < 9.5; y += 0.31) {
        CHECK(built.job.part->value({-6, y, 5.5}) < 0);
        CHECK((built.job.part->value({6, y, 5.5}) < 0) == (bare.job.part->value({6, y, 5.5}) < 0));
        more += !(bare.job.part->value({-6, y, 5.5}) < 0);
    }
    CHECK(more > 20);
}

TEST_CASE("later regions win") {
    const BuiltJob holed = build(region("ball", "\"solid\"") + region("shaft", "\"empty\""));
    CHECK(holed.job.part->value({2, 1, 0}) > 0);
    CHECK(holed.job.part->value({2, 4, 0}) < 0);
    const BuiltJob filled = build(region("shaft", "\"empty\"") + region("ball", "\"solid\""));
    CHECK(filled.job.part->value({2, 1, 0}) < 0);
    const BuiltJob small =
        build(region("half", "\"foam\"\ncell = 2") + region("ball", "\"foam\"\ncell = 1.5"));
    CHECK(small.foam->cell.made->at({-1, 1, 0}) == 1.5);
    const BuiltJob large =
        build(region("ball", "\"foam\"\ncell = 1.5") + region("half", "\"foam\"\ncell = 2"));
    CHECK(large.foam->cell.made->at({-1, 1, 0}) == 2);
    CHECK(large.foam->cell.made->at({2, 1, 0}) == 1.5);
}

TEST_CASE("a formula's region reaches through the whole part and blends over the stated width") {
    // Its value changes by 2 per mm, which its slope makes up for.
    const BuiltJob built = build(region("half", "\"foam\"\ncell = 3.6\nblend = 2"));
    const Grading& cell = *built.foam->cell.made;
    CHECK(cell.at({-1.001, 3, 2}) == 3.6);
    CHECK(cell.at({-11.9, 9.9, -5.9}) == 3.6);
    CHECK(cell.at({0, -7, 1}) == Approx(3.0));
    CHECK(cell.at({-0.5, -7, 1}) == Approx(2.4 + 1.2 * 0.84375).epsilon(1e-6));
    CHECK(cell.at({1.001, 0, 0}) == 2.4);
}

TEST_CASE("regions give the same layers whatever the order and the thread they are asked in") {
    const std::string text = skin + region("ball", "\"solid\"\nblend = 1") +
                             region("shaft", "\"empty\"\nblend = 0.5") +
                             region("half", "\"foam\"\ncell = 1.8\nblend = 3") +
                             region("half", "\"skin\"\nthickness = 0.4\nblend = 2");
    const BuiltJob built = build(text);
    const std::vector<RunRows> once = layers(built, 0.1);
    std::vector<std::vector<RunRows>> again(3);
    std::vector<std::thread> threads;
    for (auto& result : again) {
        threads.emplace_back([&result, &text] { result = layers(build(text), 0.1); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const auto& result : again) CHECK(result == once);
}

TEST_CASE("the foam alone, without its part, has the region's numbers too") {
    RecipeDraft draft;
    draft.read_text(block + region("ball", "\"foam\"\ncell = 1.3"), "test.toml");
    const BuiltFoam foam = build_foam_alone(draft.finish(), {dvec3(-8), dvec3(8)});
    CHECK(foam.cell.made->at({2, 1, 0}) == 1.3);
    CHECK(foam.cell.made->at({7, 7, 7}) == 2.4);
}

}  // namespace build_regions_test
