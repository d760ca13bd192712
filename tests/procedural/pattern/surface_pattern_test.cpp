// Patterns by example on bodies: one piece, shares, threads, bounds, and recipes with them.
#include "procedural/pattern/surface_pattern.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/base/disjoint_sets.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "recipe/build/build_job.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/commands/recipes.h"

namespace surface_pattern_test {

using namespace lamella;

namespace {

const std::string inputs = std::string(LAMELLA_SOURCE_DIR) + "/examples/inputs/";

std::string skinned(const std::string& part, const std::string& keys) {
    return "[part]\n" + part + "[skin]\nthickness = 1\npattern = \"by-example\"\nstrut = 0.8\n" + keys;
}

std::string picture(const std::string& name, double size) {
    return "image = \"" + inputs + name + "\"\nimage_size = " + std::to_string(size) + "\n";
}

/// Returns the number of pieces of a part on a lattice, over the six neighbours of each point.
std::size_t pieces_of_part(const Field& part, const Box& bounds, double step) {
    const glm::ivec3 n = glm::ivec3(glm::ceil(bounds.size() / step)) + 1;
    std::vector<std::uint8_t> solid(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                                    static_cast<std::size_t>(n.z));
    const auto place = [&](int x, int y, int z) {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(n.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(n.x) +
               static_cast<std::size_t>(x);
    };
    parallel_for(n.z, [&](int z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x)
                solid[place(x, y, z)] = part.value(bounds.lo + dvec3(x, y, z) * step) < 0 ? 1 : 0;
        }
    });
    DisjointSets sets(solid.size());
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) {
                const auto at = place(x, y, z);
                if (solid[at] == 0) continue;
                const auto join = [&](std::size_t other) {
                    if (solid[other] != 0)
                        sets.join(static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(other));
                };
                if (x + 1 < n.x) join(place(x + 1, y, z));
                if (y + 1 < n.y) join(place(x, y + 1, z));
                if (z + 1 < n.z) join(place(x, y, z + 1));
            }
        }
    }
    std::size_t pieces = 0;
    for (std::size_t i = 0; i < solid.size(); ++i)
        pieces += solid[i] != 0 && sets.find(static_cast<std::uint32_t>(i)) == i ? 1 : 0;
    return pieces;
}

}  // namespace

TEST_CASE("a skin by example is one piece and as open as its picture", "[texture]") {
    const std::string sphere = "shape = \"sphere\"\nradius = 9\n",
                      torus = "shape = \"torus\"\nradius = 9\ntube = 4\n",
                      box = "shape = \"box\"\nsize = [14, 14, 10]\n";
    struct Case {
        std::string part, keys;
    };
    for (const Case& tried :
         {Case{sphere, picture("blobs.png", 20)}, Case{torus, picture("net.png", 36) + "invert = true\n"},
          Case{box, picture("spots.png", 20)}, Case{sphere, picture("net.png", 24)}}) {
        CAPTURE(tried.part, tried.keys);
        const BuiltJob job = build_job(recipe_of(skinned(tried.part, tried.keys)));
        CHECK(pieces_of_part(*job.designed.part, job.body->bounds(), 0.2) == 1);
        REQUIRE(job.pattern);
        // Bridges between pieces close more.
        if (job.pattern->joins < 10)
            CHECK(1 - job.pattern->open_share == Approx(1 - job.pattern->picture_share).epsilon(0.05));
        // Half way through the skin, by points of the body on a spiral about its middle.
        const Box bounds = job.body->bounds();
        int open = 0, count = 0;
        for (dvec3 p = bounds.lo; p.z < bounds.hi.z; p.z += 0.11) {
            for (p.y = bounds.lo.y; p.y < bounds.hi.y; p.y += 0.23) {
                for (p.x = bounds.lo.x; p.x < bounds.hi.x; p.x += 0.23) {
                    if (std::abs(job.body->value(p) + 0.5) > 0.1) continue;
                    open += job.designed.part->value(p) > 0 ? 1 : 0;
                    ++count;
                }
            }
        }
        CHECK(static_cast<double>(open) / count == Approx(job.pattern->open_share).margin(0.03));
    }
}

TEST_CASE("a skin by example is the same on any number of threads, and a bound", "[texture]") {
    const auto body = build_job(recipe_of("[part]\nshape = \"torus\"\nradius = 6\ntube = 3\n")).body;
    SurfacePatternSettings settings;
    settings.example.size = 20;
    const auto made = [&](int threads) {
        ThreadArena arena(threads);
        return std::make_shared<const SurfacePattern>(arena.execute(
            [&] { return synthesise_on_surface(read_picture(inputs + "blobs.png"), *body, settings); }));
    };
    const auto one = made(1), four = made(4);
    REQUIRE(one->bricks().bricks.size() == four->bricks().bricks.size());
    for (std::size_t i = 0; i < one->bricks().bricks.size(); ++i)
        REQUIRE(one->bricks().bricks[i].steps == four->bricks().bricks[i].steps);
    CHECK(one->bricks().bytes() < 4'000'000);
    for (double x = -9; x < 9; x += 0.173) {
        for (double z = -3; z < 3; z += 0.05) {
            const double here = one->value({x, 1.1, z}), above = one->value({x, 1.1, z + 0.05});
            REQUIRE(here == four->value({x, 1.1, z}));
            // Where the pattern ends, away from the surface, it is solid.
            if (std::abs(here) > 1e-9 && std::abs(above) > 1e-9)
                CHECK(std::abs(above - here) <= 0.05 * (1 + 1e-9));
        }
    }
}

TEST_CASE("skins by example that cannot be made are refused", "[texture]") {
    const std::string sphere = "shape = \"sphere\"\nradius = 6\n";
    const auto told = [](const std::string& text) { return complaint_about(text); };
    CHECK(mentions(told(skinned(sphere, "")), "image"));
    CHECK(mentions(told(skinned(sphere, picture("blobs.png", 3))), "accepted: a picture of more pixels"));
    CHECK(mentions(told(skinned("shape = \"sphere\"\nradius = 600\n", picture("blobs.png", 20))),
                   "accepted: wider struts, or a smaller part"));
    CHECK(mentions(told(skinned(sphere, picture("blobs.png", 20) + "window = 3\n")), "window"));
}

TEST_CASE("the sign of a pattern stays as far along a line as it is told", "[texture]") {
    // Two bricks of smooth samples with a gap, and nothing beside them.
    SurfaceBricks bricks{.spacing = 0.25, .unit = 0.01, .slope = 3};
    for (int i = 0; i < 2; ++i) {
        PatternBrick& brick = bricks.bricks.emplace_back();
        brick.corner = {i - 1, 0, -1};
        for (int k = 0; k < PatternBrick::samples; ++k) {
            const glm::ivec3 in(k % PatternBrick::side, k / PatternBrick::side % PatternBrick::side,
                                k / PatternBrick::side / PatternBrick::side);
            const dvec3 at = dvec3(in) + 8.0 * dvec3(brick.corner);
            const double wave = 30 * std::sin(0.9 * at.x) + 25 * std::cos(0.7 * at.y - 0.4 * at.z);
            brick.steps[static_cast<std::size_t>(k)] =
                at.x > 5 && at.y > 5 ? PatternBrick::no_sample : static_cast<std::int16_t>(wave);
        }
    }
    const SurfacePattern pattern(bricks);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> anywhere(-2.3, 2.3);
    const double nowhere = pattern.value(dvec3(50));
    double sum = 0, sum_of_values = 0;
    for (int i = 0; i < 20000; ++i) {
        const dvec3 p(anywhere(random), anywhere(random), anywhere(random));
        const int axis = i % 3;
        const bool ascending = i % 2 == 0;
        std::uint32_t hint = 0;
        const WindowPattern::Stretch stretch = pattern.stretch_near(p, axis, ascending, hint);
        REQUIRE(stretch.value == pattern.value(p));
        REQUIRE(stretch.same >= std::abs(stretch.value));
        sum += stretch.same;
        sum_of_values += std::abs(stretch.value);
        for (int k = 1; k < 16; ++k) {
            dvec3 onward = p;
            onward[axis] += (ascending ? 1 : -1) * stretch.same * k / 16;
            const double value = pattern.value(onward);
            if (value == nowhere && stretch.value != nowhere) break;  // no sample tells how far that is
            REQUIRE((value < 0) == (stretch.value < 0));
        }
    }
    CHECK(sum > 3 * sum_of_values);
}

}  // namespace surface_pattern_test
