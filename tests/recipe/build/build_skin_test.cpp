// Skins with windows and holes from recipes: holes' volumes, drains, refusals, identities.
#include "recipe/build/build_skin.h"

#include <catch2/catch.hpp>

#include "engine/field/slice_context.h"
#include "engine/surveys/cavity_survey.h"
#include "recipe/identity.h"
#include "tests/app/commands/recipes.h"

namespace build_skin_test {

using namespace lamella;

namespace {

std::string recipe(const std::string& part, const std::string& text) {
    return "[part]\n" + part + "\n" + text + "[layers]\nheight = 0.1\n";
}

BuiltJob built(const std::string& part, const std::string& text) {
    return build_job(recipe_of(recipe(part, text)));
}

const std::string block = "shape = \"box\"\nsize = [20, 20, 10]";
const std::string ball = "shape = \"sphere\"\nradius = 10";

/// Area of the part in the plane at z, mm^2.
double area(const BuiltJob& job, double z) {
    constexpr double pitch = 0.02;
    const Box& box = job.job.bounds;
    RowBand band;
    band.along_pitch = band.across_pitch = pitch;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.count = static_cast<int>(box.size().y / pitch + 0.5);
    band.hi = static_cast<int>(box.size().x / pitch + 1.5);
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(*job.job.part, z).runs(band, scratch, rows);
    return static_cast<double>(rows.total_length()) / run_unit * pitch * pitch;
}

double volume(const BuiltJob& job) {
    double sum = 0;
    for (int layer = 0; layer < job.job.layers.count(); ++layer)
        sum += area(job, job.job.bounds.lo.z + (layer + 0.5) * 0.1) * 0.1;
    return sum;
}

CavitySurvey cavities(const BuiltJob& job) {
    CavitySurveyOptions options;
    options.pitch = 0.3;
    return survey_cavities(job.job, options);
}

std::string complaint(const std::string& part, const std::string& text) {
    return complaint_about(recipe(part, text));
}

}  // namespace

TEST_CASE("a hole takes a cylinder out of the skin, and of nothing else") {
    const std::string skin = "[skin]\nthickness = 1\n";
    const BuiltJob whole = built(block, skin);
    const BuiltJob drilled = built(block, skin + "[[hole]]\nat = [1, 2, 5.3]\nradius = 2\n");
    CHECK(volume(whole) - volume(drilled) == Approx(pi * 4).epsilon(2e-3));
    CHECK(area(whole, 4.55) - area(drilled, 4.55) == Approx(pi * 4).epsilon(2e-3));
    REQUIRE(drilled.holes.size() == 1);
    const dvec3 to = drilled.holes[0].to;
    CHECK(to.x == Approx(1).margin(1e-3));
    CHECK(to.y == Approx(2).margin(1e-3));
    CHECK(to.z < 4);
}

TEST_CASE("an oblique hole goes all the way through the skin") {
    const std::string skin = "[skin]\nthickness = 1\n";
    const BuiltJob whole = built(block, skin);
    const BuiltJob drilled =
        built(block, skin + "[[hole]]\nat = [0, 0, 5]\nradius = 1.5\ndirection = [1, 0, -1]\n");
    // Every plane cuts an ellipse, sqrt(2) longer than wide.
    CHECK(volume(whole) - volume(drilled) == Approx(pi * 1.5 * 1.5 * std::sqrt(2)).epsilon(3e-3));
}

TEST_CASE("a hole leaves the foam alone, unless it goes through") {
    const std::string foam = "[foam]\ncell = 3\nbeam = 0.5\n[skin]\nthickness = 1\n";
    const std::string hole = "[[hole]]\nat = [0, 0, 5]\nradius = 3\ndepth = 11\n";
    const std::string bare = "[foam]\ncell = 3\nbeam = 0.5\n";
    const BuiltJob left = built(block, foam + hole), through = built(block, foam + hole + "through = true\n");
    const BuiltJob alone = built(block, bare);
    for (double x = -2; x <= 2; x += 0.25) {
        for (double z = -4.9; z < 5; z += 0.35) {
            const dvec3 p(x, 0.4, z);
            CHECK((left.job.part->value(p) < 0) == (alone.job.part->value(p) < 0));
            CHECK(through.job.part->value(p) > 0);
        }
    }
}

TEST_CASE("drains and vents lead out of a hollow ball's cavity, whose volume is told") {
    const std::string skin = "[skin]\nthickness = 1\ndrain_radius = 1\n";
    const BuiltJob one = built(ball, skin + "drains = 1\n"), two = built(ball, skin + "drains = 2\n");
    REQUIRE(one.drains);
    CHECK(one.drains->cavities == 1);
    CHECK(one.drains->volume == Approx(4.0 / 3 * pi * 729).epsilon(2e-3));
    REQUIRE(one.drains->holes.size() == 1);
    REQUIRE(two.drains->holes.size() == 2);
    CHECK(one.drains->drained[0].lowest.z == Approx(-9).margin(0.15));
    CHECK(cavities(one).count == 0);
    CHECK(cavities(two).count == 0);
    CHECK(cavities(built(ball, "[skin]\nthickness = 1\n")).count == 1);
    // Down at the bottom, up at the top, through the whole skin.
    for (double r = 9.01; r < 10; r += 0.2) {
        CHECK(one.job.part->value({0, 0, -r}) > 0);
        CHECK(one.job.part->value({0, 0, r}) < 0);
        CHECK(two.job.part->value({0, 0, r}) > 0);
    }
    CHECK(mentions(drains_text(*two.drains), "1 closed cavity of 30"));
    CHECK(mentions(drains_text(*two.drains), "2 holes drilled"));
}

TEST_CASE("a cavity that a hole or a window opens needs no drain") {
    const std::string skin = "[skin]\nthickness = 1\ndrains = 1\n";
    CHECK(built(ball, skin + "[[hole]]\nat = [10, 0, 0]\nradius = 1\n").drains->cavities == 0);
    const BuiltJob windows =
        built(ball, "[skin]\nthickness = 1\ndrains = 1\npattern = \"voronoi\"\nwindow = 3\nstrut = 1\n");
    CHECK(windows.drains->cavities == 0);
    CHECK(drains_text(*windows.drains) == "no cavity is closed");
}

TEST_CASE("windows of a recipe open the skin, behind which foam stays") {
    const std::string skin = "[skin]\nthickness = 1\npattern = \"hexagons\"\nwindow = 3\nstrut = 0.8\n";
    const BuiltJob hollow = built(block, skin);
    REQUIRE(hollow.pattern);
    CHECK(hollow.pattern->windows > 60);
    const BuiltJob filled = built(block, skin + "[foam]\ncell = 3\nbeam = 0.5\n");
    const BuiltJob bare = built(block, "[foam]\ncell = 3\nbeam = 0.5\n");
    int both = 0;
    for (double x = -9.9; x < 10; x += 0.37) {
        for (double y = -9.9; y < 10; y += 0.37) {
            const dvec3 p(x, y, 4.7);
            const bool solid = hollow.job.part->value(p) < 0 || bare.job.part->value(p) < 0;
            CHECK((filled.job.part->value(p) < 0) == solid);
            both += solid;
        }
    }
    CHECK(both > 500);
}

TEST_CASE("skins that cannot be are refused with the key that is to blame") {
    const std::string skin = "[skin]\nthickness = 1\n";
    CHECK(mentions(complaint(ball, skin + "pattern = \"voronoi\"\nstrut = 1\n"), "skin.window: missing"));
    CHECK(mentions(complaint(ball, skin + "pattern = \"hexagons\"\nwindow = 1\nstrut = 1\nseed = 4\n"),
                   "skin.seed: does not apply to pattern hexagons"));
    CHECK(mentions(complaint(ball, skin + "window = 2\n"), "does not apply to pattern closed"));
    CHECK(mentions(complaint(ball, skin + "drain_radius = 2\n"), "has no effect without drains"));
    CHECK(mentions(complaint(ball, skin + "drains = 1\ndrain_pitch = 90\n"), "drain_pitch"));
    CHECK(mentions(
        complaint(ball, skin + "drains = 1\n[foam]\nkind = \"closed\"\ncell = 3\nbeam = 0.3\nwall = 0.3\n"),
        "too many to drain"));
    CHECK(mentions(complaint(ball, "[[hole]]\nat = [0, 0, 10]\nradius = 1\n"),
                   "holes are drilled through a skin, and there is none"));
    CHECK(mentions(complaint(ball, skin + "[[hole]]\nradius = 1\n"), "hole.at: missing"));
    CHECK(mentions(complaint(ball, skin + "[[hole]]\nat = [0, 0, 10]\nradius = 1\ndirection = [0, 0, 1]\n"),
                   "does not lead into the body"));
    CHECK(mentions(complaint(ball, skin + "pattern = \"image\"\nimage = \"nowhere.png\"\nimage_size = 9\n"
                                          "strut = 1\n"),
                   "nowhere.png"));
    CHECK(mentions(complaint(ball, skin + "pattern = \"voronoi\"\nwindow = 2\nstrut = \"z\"\n"), "strut"));
    const std::string blobs = "image = \"" LAMELLA_SOURCE_DIR "/examples/inputs/blobs.png\"\nstrut = 0.8\n";
    CHECK(mentions(complaint(ball, skin + "pattern = \"image\"\n" + blobs + "image_size = \"9 + 0.1*z\"\n"),
                   "the size of a picture that is tiled is the same everywhere"));
    const std::string by_example = skin + "pattern = \"by-example\"\n" + blobs;
    CHECK(mentions(complaint(ball, by_example + "image_size = 20\nsecond_weight = 0.5\n"),
                   "skin.second_weight: has no effect without skin.second_image"));
    CHECK(mentions(complaint(ball, by_example + "image_size = 20\nsecond_image = \"nowhere.png\"\n"),
                   "skin.second_image: has no effect without skin.second_weight"));
    CHECK(mentions(complaint(ball, by_example + "image_size = \"24 + 2*z\"\n"),
                   "accepted: the largest at most 3.6 times the smallest"));
}

TEST_CASE("windows, holes and drains change a job's identity") {
    const auto identity = [](const std::string& text) {
        return job_identity(recipe_of("[part]\nshape = \"sphere\"\nradius = 10\n" + text));
    };
    const std::string skin = "[skin]\nthickness = 1\n",
                      voronoi = skin + "pattern = \"voronoi\"\nwindow = 2\nstrut = 1\n";
    const std::vector<std::string> all{
        identity(skin),
        identity(voronoi),
        identity(voronoi + "seed = 2\n"),
        identity(skin + "drains = 1\n"),
        identity(skin + "[[hole]]\nat = [0, 0, 10]\nradius = 1\n"),
        identity(skin + "[[hole]]\nat = [0, 0, 10]\nradius = 1\nthrough = true\n")};
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) CHECK(all[i] != all[j]);
    }
}

}  // namespace build_skin_test
