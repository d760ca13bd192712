// Drains of meshes: every closed cavity gets a way out, whatever the shells of the mesh do.
#include "recipe/build/place_drains.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <random>

#include "engine/layers/survey_rows.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"
#include "tests/engine/mesh/mesh_samples.h"

namespace place_drains_test {

using namespace lamella;

namespace {

BuiltJob drained(const Folder& folder, const TriangleMesh& mesh, double skin, double layer_height) {
    write(folder / "part.stl", samples::binary_stl(mesh));
    return build_job(
        recipe_of(fmt::format("[part]\nmesh = \"{}\"\n[skin]\nthickness = {}\ndrains = 1\n"
                              "[layers]\nheight = {}\n",
                              folder / "part.stl", skin, layer_height)));
}

/// The closed cavities that are left, as fine as the drains were placed.
CavitySurvey left_closed(const BuiltJob& built, double skin) {
    const Interval suited = survey_pitch_range(built.job);
    CavitySurveyOptions options;
    options.pitch = std::min(std::max(skin / 3, suited.lo), suited.hi);
    return survey_cavities(built.job, options);
}

TriangleMesh box_of(std::mt19937& random, int lo, int hi) {
    std::uniform_int_distribution<int> size(lo, hi), corner(0, 8);
    const dvec3 at(corner(random), corner(random), corner(random));
    return samples::box_mesh(at, at + dvec3(size(random), size(random), size(random)));
}

}  // namespace

TEST_CASE("a box of whole numbers is one cavity, and gets its drain", "[drains]") {
    const Folder folder;
    const BuiltJob built = drained(folder, samples::box_mesh(dvec3(0), {11, 12, 34}), 1.2, 0.2);
    REQUIRE(built.drains);
    CHECK(built.drains->cavities == 1);
    CHECK(built.drains->volume == Approx(8.6 * 9.6 * 31.6).epsilon(0.01));
    CHECK(built.drains->holes.size() == 1);
    CHECK(left_closed(built, 1.2).count == 0);
}

TEST_CASE("shells that overlap, or lie in each other, are drained to the outside", "[drains]") {
    const Folder folder;
    TriangleMesh overlap = samples::box_mesh(dvec3(0), {20, 20, 20}), nested = overlap;
    samples::append(overlap, samples::box_mesh({15, 5, 5}, {35, 15, 15}));
    samples::append(nested, samples::box_mesh(dvec3(6), dvec3(14)));
    for (const TriangleMesh& mesh : {overlap, nested}) {
        const BuiltJob built = drained(folder, mesh, 0.8, 0.2);
        REQUIRE(built.drains);
        CHECK(built.drains->cavities >= 2);
        CHECK(built.drains->kept.empty());
        CHECK(left_closed(built, 0.8).count == 0);
    }
}

TEST_CASE("of 300 random parts of boxes no cavity stays closed that could hold a drain", "[drains]") {
    const Folder folder;
    std::mt19937 random(77);
    const double skins[] = {0.6, 0.8, 1, 1.2, 2};
    int cavities = 0;
    for (int round = 0; round < 300; ++round) {
        TriangleMesh mesh = box_of(random, 4, 16);
        if (round % 2 == 1) samples::append(mesh, box_of(random, 4, 16));
        const double skin = skins[random() % 5];
        const BuiltJob built = drained(folder, mesh, skin, 0.2);
        REQUIRE(built.drains);
        cavities += static_cast<int>(built.drains->cavities);
        INFO("round " << round << ", skin " << skin << ": " << drains_text(*built.drains));
        CHECK(built.drains->kept.empty());
        CHECK(left_closed(built, skin).count == built.drains->small);
    }
    CHECK(cavities > 250);
}

}  // namespace place_drains_test
