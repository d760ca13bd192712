// Patterns written and read again, and files that are damaged.
#include "procedural/pattern/pattern_file.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "engine/base/error.h"
#include "engine/solids/primitives.h"
#include "recipe/build/build_job.h"
#include "recipe/build/pattern_plan.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace pattern_file_test {

using namespace lamella;

namespace {

SurfaceBricks two_bricks() {
    SurfaceBricks bricks{.spacing = 0.2,
                         .unit = 5e-5,
                         .slope = 1.5,
                         .share = 0.4,
                         .wanted_share = 0.45,
                         .pieces = 7,
                         .joins = 6,
                         .bridges = 9,
                         .cut_struts = 1,
                         .detours = 2,
                         .hanging = 4,
                         .dropped = 3};
    for (const glm::i64vec3 corner : {glm::i64vec3(0, 0, 0), glm::i64vec3(-3, 2, 1)}) {
        PatternBrick& brick = bricks.bricks.emplace_back();
        brick.corner = corner;
        for (std::size_t k = 0; k < brick.steps.size(); ++k)
            brick.steps[k] = static_cast<std::int16_t>(k % 5 == 0 ? PatternBrick::no_sample
                                                                  : 31 * static_cast<int>(k) - 9000);
    }
    return bricks;
}

SurfaceBricks read(const std::string& bytes) {
    std::istringstream in(bytes);
    return read_surface_bricks(in, "test.pattern");
}

void check_equal(const SurfaceBricks& a, const SurfaceBricks& b) {
    CHECK(a.spacing == b.spacing);
    CHECK(a.unit == b.unit);
    CHECK(a.slope == b.slope);
    CHECK(a.share == b.share);
    CHECK(a.wanted_share == b.wanted_share);
    CHECK(a.pieces == b.pieces);
    CHECK(a.dropped == b.dropped);
    CHECK(a.joins == b.joins);
    CHECK(a.bridges == b.bridges);
    CHECK(a.cut_struts == b.cut_struts);
    CHECK(a.hanging == b.hanging);
    CHECK(a.detours == b.detours);
    REQUIRE(a.bricks.size() == b.bricks.size());
    for (std::size_t i = 0; i < a.bricks.size(); ++i) {
        CHECK(a.bricks[i].corner == b.bricks[i].corner);
        CHECK(a.bricks[i].steps == b.bricks[i].steps);
    }
}

}  // namespace

TEST_CASE("a pattern is read as it was written", "[texture]") {
    const Folder folder;
    const std::string file = folder / "a.pattern";
    write_surface_bricks(file, two_bricks());
    check_equal(read(contents(file)), two_bricks());
}

TEST_CASE("files of patterns that are damaged or make no sense are refused", "[texture]") {
    const Folder folder;
    const std::string file = folder / "a.pattern";
    write_surface_bricks(file, two_bricks());
    const std::string whole = contents(file);
    for (std::size_t length = 0; length < whole.size(); length += 13)
        CHECK_THROWS_AS(read(whole.substr(0, length)), InputError);
    CHECK_THROWS_AS(read(whole + "more"), InputError);
    for (std::size_t at = 0; at < whole.size(); at += 7) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        CHECK_THROWS_AS(read(damaged), InputError);
    }
    const auto refused = [&](const auto& change) {
        SurfaceBricks bricks = two_bricks();
        change(bricks);
        write_surface_bricks(file, bricks);
        CHECK_THROWS_AS(read(contents(file)), InputError);
    };
    refused([](SurfaceBricks& b) { b.spacing = 0; });
    refused([](SurfaceBricks& b) { b.unit = -1; });
    refused([](SurfaceBricks& b) { b.slope = 0.5; });
    refused([](SurfaceBricks& b) { b.share = std::nan(""); });
    refused([](SurfaceBricks& b) { b.bricks[1].corner = b.bricks[0].corner; });
    refused([](SurfaceBricks& b) { b.bricks[1].corner.x = std::int64_t{1} << 50; });
}

TEST_CASE("a pattern is made once for all runs of its body and skin", "[texture]") {
    const Folder folder;
    const std::string text =
        "[part]\nshape = \"sphere\"\nradius = 5\n[skin]\nthickness = 1\npattern = \"by-example\"\n"
        "strut = 0.8\nimage_size = 20\nimage = \"" LAMELLA_SOURCE_DIR "/examples/inputs/blobs.png\"\n";
    const Recipe recipe = recipe_of(text);
    const auto body = make_sphere({0, 0, 0}, 5);
    SurfacePatternSettings settings;
    const SurfaceBricks made = pattern_plan(recipe, *body, settings, folder.path());
    const std::filesystem::path file = folder.path() / (pattern_hash(recipe, settings.depth) + ".pattern");
    REQUIRE(std::filesystem::exists(file));
    // What the folder keeps is taken, as long as it is whole.
    SurfaceBricks other = two_bricks();
    write_surface_bricks(file, other);
    check_equal(pattern_plan(recipe, *body, settings, folder.path()), other);
    std::ofstream(file) << "not a pattern";
    check_equal(pattern_plan(recipe, *body, settings, folder.path()), made);
    check_equal(pattern_plan(recipe, *body, settings, {}), made);
    const std::string hash = pattern_hash(recipe, 1);
    const auto hash_with = [&](const std::string& more) { return pattern_hash(recipe_of(text + more), 1); };
    CHECK(hash_with("[layers]\nheight = 0.1\n") == hash);
    CHECK(hash_with("[foam]\ncell = 2\nbeam = 0.2\n") == hash);
    CHECK(hash_with("seed = 2\n") != hash);
    CHECK(hash_with("gap = 0.4\n") != hash);
    CHECK(pattern_hash(recipe, 2) != hash);
}

TEST_CASE("a region that makes the skin thicker does not get the pattern of a thin one", "[texture]") {
    const Folder folder;
    const std::string text =
        "[part]\nshape = \"sphere\"\nradius = 6\n[skin]\nthickness = 0.8\npattern = \"by-example\"\n"
        "strut = 0.8\nimage_size = 20\nimage = \"" LAMELLA_SOURCE_DIR "/examples/inputs/blobs.png\"\n";
    const std::string thicker =
        "[[field]]\nname = \"top\"\nformula = \"-z\"\n"
        "[[region]]\nfield = \"top\"\nmake = \"skin\"\nthickness = 3\n";
    const OptimizeOptions kept{.plans = folder.path()};
    build_job(recipe_of(text), kept);
    const BuiltJob after = build_job(recipe_of(text + thicker), kept),
                   anew = build_job(recipe_of(text + thicker));
    for (double x = -5; x < 5; x += 0.31) {
        for (double z = 0.2; z < 5; z += 0.17) {
            const dvec3 p(x, 0.4, z);
            REQUIRE(after.designed.part->value(p) == anew.designed.part->value(p));
        }
    }
}

}  // namespace pattern_file_test
