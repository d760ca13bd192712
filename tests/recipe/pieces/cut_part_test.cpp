// Pieces against closed forms: nothing is lost, nothing overlaps, pins fit their holes.
#include "recipe/pieces/cut_part.h"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "engine/contours/contours.h"
#include "recipe/build/build_job.h"
#include "recipe/read_recipe.h"
#include "recipe/recipe_draft.h"

namespace cut_part_test {

using namespace lamella;

namespace {

constexpr double pi = std::numbers::pi;

Recipe recipe_of(const std::string& text) {
    RecipeDraft draft;
    draft.read_text(text, "cut.toml");
    return draft.finish();
}

const std::string box =
    "[part]\nshape = \"box\"\nsize = [60, 40, 30]\n[layers]\nheight = 0.1\n[printer]\nprofile = \"marlin\"\n";

/// The pieces of a recipe, each where it was in the whole.
std::vector<BuiltJob> pieces_of_recipe(const Recipe& recipe) {
    std::vector<BuiltJob> pieces;
    pieces.push_back(build_job(first_piece(recipe)));
    for (const Recipe& other : other_pieces(recipe, pieces.front().pieces))
        pieces.push_back(build_job(other));
    return pieces;
}

double volume(const Job& job) {
    double sum = 0;
    for (int i = 0; i < job.layers.count(); ++i) {
        const Layer layer(job, i);
        for (const Contour& contour : layer.contours(0.01))
            sum += signed_area(contour.points) * layer.thickness();
    }
    return sum;
}

/// Random points of a box.
std::vector<dvec3> points_in(const Box& where, int count) {
    std::mt19937_64 bits(7);
    std::vector<dvec3> points;
    for (int i = 0; i < count; ++i) {
        const auto share = [&] { return static_cast<double>(bits() >> 11U) * 0x1p-53; };
        const dvec3 shares(share(), share(), share());
        points.push_back(where.lo + where.size() * shares);
    }
    return points;
}

}  // namespace

TEST_CASE("two pieces have the volume of the whole, less the clearance", "[cut]") {
    const auto pieces = pieces_of_recipe(recipe_of(box + "[[cut]]\nat = [0, 0, -3]\njoint = \"pins\"\njoints "
                                                         "= 2\ndiameter = 5\ndepth = 7\nclearance = 0.2\n"));
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].pieces == 2);
    CHECK(pieces[0].job.name == "box_1");
    CHECK(volume(pieces[0].job) == Approx(60 * 40 * 12 + 2 * pi * 2.5 * 2.5 * 7).epsilon(1e-4));
    CHECK(volume(pieces[1].job) == Approx(60 * 40 * 18 - 2 * pi * 2.7 * 2.7 * 7.2).epsilon(1e-4));
    CHECK(pieces[0].job.bounds.hi.z == Approx(4).margin(1e-3));
    CHECK(pieces[1].job.bounds.lo.z == Approx(-3).margin(1e-3));
}

TEST_CASE("pieces do not overlap, and miss nothing but the gap about their pins", "[cut]") {
    const std::string turned = GENERATE("", "turn = [20, -35, 50]\n");
    const Recipe recipe =
        recipe_of("[part]\nshape = \"box\"\nsize = [60, 40, 30]\n" + turned +
                  "[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n" +
                  "[[cut]]\nnormal = [0.2, 0.1, 1]\njoint = \"pins\"\njoints = 3\nclearance = 0.3\n");
    const auto pieces = pieces_of_recipe(recipe);
    REQUIRE(pieces.size() == 2);
    const BuiltJob whole = build_job(recipe);
    int in_gap = 0, in_pin = 0;
    const dvec3 normal = pieces[0].axes * glm::normalize(dvec3(0.2, 0.1, 1));
    for (const dvec3 p : points_in(whole.job.bounds, 200000)) {
        const bool low = pieces[0].job.part->value(p) < 0, high = pieces[1].job.part->value(p) < 0;
        CHECK_FALSE((low && high));
        if (low || high) CHECK(whole.job.part->value(p) < 1e-9);
        if (low && dot(normal, p) > 1e-6) ++in_pin;
        if (whole.job.part->value(p) < 0 && !low && !high) {
            ++in_gap;
            CHECK(dot(normal, p) > -1e-6);  // holes are in the upper piece
        }
    }
    const dvec3 size = whole.job.bounds.size();
    const double each = size.x * size.y * size.z / 200000;
    const double pins = 3 * pi * 2 * 2 * 6, holes = 3 * pi * 2.3 * 2.3 * 6.3;
    CHECK(in_pin * each == Approx(pins).epsilon(0.15));
    CHECK(in_gap * each == Approx(holes - pins).epsilon(0.25));
}

TEST_CASE("crossing planes make four pieces", "[cut]") {
    const auto pieces = pieces_of_recipe(
        recipe_of(box + "[[cut]]\nnormal = [1, 0, 0.3]\n[[cut]]\nat = [0, 4, 0]\nnormal = [0, 1, 0]\n"));
    REQUIRE(pieces.size() == 4);
    double all = 0;
    for (const BuiltJob& piece : pieces) all += volume(piece.job);
    CHECK(all == Approx(60 * 40 * 30).epsilon(1e-4));
}

TEST_CASE("each piece stands on its lowest point", "[cut]") {
    const Recipe recipe = recipe_of(box + "[[cut]]\nat = [0, 0, 5]\n");
    const auto pieces = pieces_of_recipe(recipe);
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].job.layers.count() == 200);
    CHECK(pieces[1].job.layers.count() == 100);
    Recipe beyond = recipe;
    beyond.plate.piece = 3;
    CHECK_THROWS_WITH(build_job(beyond), Catch::Contains("the cuts make 2") && Catch::Contains("1 to 2"));
}

TEST_CASE("a plane that reaches a part of the pieces joins those alone", "[cut]") {
    // An L: the second plane divides its upright leg only.
    const Recipe recipe = recipe_of(
        "[part]\nfield = \"l\"\n[[field]]\nname = \"l\"\nbounds = [[0, 0, 0], [60, 20, 60]]\n"
        "formula = \"max(min(x - 20, z - 20), max(max(-x, x - 60), max(max(-y, y - 20), max(-z, z - "
        "60))))\"\n"
        "[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n"
        "[[cut]]\nat = [30, 0, 0]\nnormal = [1, 0, 0]\n[[cut]]\nat = [0, 0, 40]\njoint = \"pins\"\njoints = "
        "2\n");
    const auto pieces = pieces_of_recipe(recipe);
    REQUIRE(pieces.size() == 3);
    const double pins = 2 * pi * 2 * 2 * 6, holes = 2 * pi * 2.15 * 2.15 * 6.15;
    CHECK(volume(pieces[0].job) == Approx(20 * 20 * 40 + 10 * 20 * 20 + pins).epsilon(1e-3));
    CHECK(volume(pieces[1].job) == Approx(20 * 20 * 20 - holes).epsilon(1e-3));
    CHECK(volume(pieces[2].job) == Approx(30 * 20 * 20).epsilon(1e-3));
}

TEST_CASE("the bounds of a piece are close, however oblique the cut", "[cut]") {
    // A ball cut by an oblique plane through its middle, against the closed form of a half ball's bounds.
    const Recipe recipe = recipe_of(
        "[part]\nshape = \"sphere\"\nradius = 20\n[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n"
        "[[cut]]\nnormal = [1, 0, 2]\n");
    const auto pieces = pieces_of_recipe(recipe);
    REQUIRE(pieces.size() == 2);
    const double sine = 1 / std::sqrt(5.0), cosine = 2 / std::sqrt(5.0);
    // The upper half reaches down to the lowest point of the cut's circle, and right to the ball's side.
    const Box upper = pieces[1].job.bounds;
    CHECK(upper.lo.z == Approx(-20 * sine).margin(0.003));
    CHECK(upper.hi.z == 20);
    CHECK(upper.lo.x == Approx(-20 * cosine).margin(0.4));
    CHECK(upper.lo.x < -20 * cosine);
    CHECK(upper.hi.x == 20);
}

TEST_CASE("dowels have a hole on both sides, in material of their own", "[cut]") {
    const auto pieces = pieces_of_recipe(recipe_of(
        "[part]\nshape = \"box\"\nsize = [40, 40, 40]\n[foam]\ncell = 8\nbeam = 0.6\n[skin]\nthickness = 1\n"
        "[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n"
        "[[cut]]\njoint = \"dowels\"\njoints = 2\nface = 0.8\nwall = 2\n"));
    REQUIRE(pieces.size() == 2);
    const CutPlane plane{{0, 0, 1}, 0};
    CutRecipe cut;
    cut.wall = 2;
    cut.joints = 2;
    const auto places =
        joint_places(build_job(recipe_of("[part]\nshape = \"box\"\nsize = [40, 40, 40]\n[layers]\nheight = "
                                         "0.2\n[printer]\nprofile = \"marlin\"\n"))
                         .body,
                     plane, cut);
    REQUIRE(places.size() == 2);
    CHECK(glm::distance(places[0], places[1]) > 12);
    for (const dvec3 place : places) {
        for (int side = 0; side < 2; ++side) {
            const Field& part = *pieces[static_cast<std::size_t>(side)].job.part;
            const double up = side == 0 ? -1 : 1;
            for (int turn = 0; turn < 12; ++turn) {
                const dvec3 out(std::cos(turn * pi / 6), std::sin(turn * pi / 6), 0);
                CHECK(part.value(place + out * 2.1 + dvec3(0, 0, up * 5.9)) > 0);   // the hole
                CHECK(part.value(place + out * 2.25 + dvec3(0, 0, up * 5.9)) < 0);  // its wall
                CHECK(part.value(place + out * 4.1 + dvec3(0, 0, up * 5.9)) < 0);
            }
        }
    }
    // Along the cut, all but the holes is solid for 0.8 mm.
    for (const dvec3 p : points_in({{-20, -20, 0.01}, {20, 20, 0.79}}, 2000)) {
        bool is_hole = false;
        for (const dvec3 place : places) is_hole = is_hole || glm::distance(dvec2(p), dvec2(place)) < 2.16;
        if (is_hole) continue;
        CHECK(pieces[1].job.part->value(p) < 0);
        CHECK(pieces[0].job.part->value(dvec3(p.x, p.y, -p.z)) < 0);
    }
}

TEST_CASE("cuts say what is wrong with them", "[cut]") {
    CHECK_THROWS_WITH(build_job(first_piece(recipe_of(box + "[[cut]]\njoint = \"pins\"\ndiameter = 30\n"))),
                      Catch::Contains("cut.toml:8") && Catch::Contains("no room for 2 joints of 30 mm"));
    CHECK_THROWS_WITH(build_job(recipe_of(box + "[[cut]]\nat = [0, 0, 40]\n")),
                      Catch::Contains("cut.toml:8") && Catch::Contains("does not divide the part"));
    CHECK_THROWS_WITH(recipe_of(box + "[[cut]]\ndiameter = 3\n"),
                      Catch::Contains("cut.toml:9") && Catch::Contains("no effect without a joint"));
    CHECK_THROWS_WITH(recipe_of(box + "[[cut]]\njoint = \"pins\"\njoints = 1\n"),
                      Catch::Contains("cut.toml:10") && Catch::Contains("2 or 3"));
    CHECK_THROWS_WITH(recipe_of(box + "[[cut]]\nnormal = [0, 0, 0]\n"), Catch::Contains("no direction"));
    CHECK_THROWS_WITH(recipe_of(box + "[plate]\npiece = 1\n"), Catch::Contains("nothing cuts the part"));
}

}  // namespace cut_part_test
