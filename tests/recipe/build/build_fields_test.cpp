// Kinds of [[field]]: shapes and meshes where they are placed, as the part and as regions.
#include "recipe/build/build_fields.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "tests/app/commands/recipes.h"
#include "tests/engine/io/implicit_samples.h"
#include "tests/engine/runs/plane_runs.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace build_fields_test {

using namespace lamella;

namespace {

const std::string path = LAMELLA_SOURCE_DIR "/examples/test.toml";

Recipe read(const std::string& text) { return recipe_of(text, path); }

FieldPtr part(const std::string& field) { return build_job(read("[[field]]\nname = \"it\"\n" + field)).body; }

std::string complaint(const std::string& text) { return complaint_about(text, path); }

}  // namespace

TEST_CASE("shapes by name are the closed forms of their kinds where they are placed") {
    const FieldPtr sphere = part("kind = \"sphere\"\nradius = 2\nat = [1, 2, 3]\n");
    const FieldPtr box = part("kind = \"box\"\nsize = [2, 4, 6]\nat = [1, 2, 3]\n");
    const FieldPtr cylinder =
        part("kind = \"cylinder\"\nradius = 1.5\nheight = 5\nat = [1, 2, 3]\nturn = [0, 90, 0]\n");
    const FieldPtr capsule =
        part("kind = \"capsule\"\nradius = 1\nheight = 6\nat = [1, 2, 3]\nturn = [90, 0, 0]\n");
    const FieldPtr torus =
        part("kind = \"torus\"\nradius = 3\ntube = 1\nat = [1, 2, 3]\nturn = [0, 90, 0]\n");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-6, 6);
    for (int i = 0; i < 2000; ++i) {
        const dvec3 q(place(random), place(random), place(random)), p = q + dvec3(1, 2, 3);
        REQUIRE(sphere->value(p) == Approx(glm::length(q) - 2).margin(1e-12));
        REQUIRE((box->value(p) < 0) == (std::abs(q.x) < 1 && std::abs(q.y) < 2 && std::abs(q.z) < 3));
        // Along x after the turn about y, and along y after the turn about x.
        REQUIRE((cylinder->value(p) < 0) == (std::abs(q.x) < 2.5 && length({q.y, q.z}) < 1.5));
        const double beyond = std::max(std::abs(q.y) - 2, 0.0);
        REQUIRE(capsule->value(p) == Approx(length({length({q.x, q.z}), beyond}) - 1).margin(1e-9));
        REQUIRE(torus->value(p) == Approx(length({length({q.y, q.z}) - 3, q.x}) - 1).margin(1e-9));
    }
}

TEST_CASE("turns are about x, then y, then z") {
    // A box long along z: about x by 90 degrees to lie along y, then about z by 30 degrees.
    const FieldPtr turned = part("kind = \"box\"\nsize = [1, 1, 8]\nturn = [90, 0, 30]\n");
    const double c = std::sqrt(3) / 2, s = 0.5;
    CHECK(turned->value({-s * 3.9, c * 3.9, 0}) < 0);
    CHECK(turned->value({-s * 4.1, c * 4.1, 0}) > 0);
    CHECK(turned->value({s * 3, c * 3, 0}) > 0);
    CHECK(turned->value({0, 0, 3}) > 0);
}

TEST_CASE("a mesh by name is read in its unit, scaled, turned and moved, with its volume kept") {
    const std::string mesh = "kind = \"mesh\"\nfile = \"models/koala_mm.obj\"\nscale = 0.5\n";
    const BuiltJob plain = build_job(read("[part]\nmesh = \"models/koala_mm.obj\"\n"));
    const BuiltJob placed =
        build_job(read("[[field]]\nname = \"it\"\n" + mesh + "at = [5, 6, 7]\nturn = [0, 0, 90]\n"));
    REQUIRE(placed.mesh);
    CHECK(placed.mesh->volume == Approx(plain.mesh->volume / 8).epsilon(1e-9));
    std::mt19937 random(4);
    const Box box = plain.job.bounds;
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 200; ++i) {
        const dvec3 p = box.lo + box.size() * dvec3(share(random), share(random), share(random));
        const dvec3 q = dvec3(-p.y, p.x, p.z) * 0.5 + dvec3(5, 6, 7);
        REQUIRE(placed.body->value(q) == Approx(plain.body->value(p) / 2).margin(1e-9));
    }
}

TEST_CASE("formulas can be placed too, and their bounds go with them") {
    const FieldPtr moved =
        part("formula = \"max(abs(x) - 1, abs(y) - 2, abs(z) - 3)\"\nat = [10, 0, 0]\nturn = [0, 0, 90]\n");
    CHECK(moved->value({11.9, 0, 0}) < 0);
    CHECK(moved->value({12.1, 0, 0}) > 0);
    CHECK(moved->value({10, 0.9, 2.9}) < 0);
    CHECK(moved->value({10, 1.1, 0}) > 0);
    CHECK(moved->bounds().hi.x < 13);
    CHECK(volume_in(*moved, {{7, -2, -4}, {13, 2, 4}}, 0.1) == Approx(48).epsilon(0.01));
}

TEST_CASE("level sets and functions of a 3MF are fields, in millimetres and where they are put") {
    using namespace lamella::samples;
    const ScratchFolder folder("fields_3mf");
    const std::string file = (folder / "ball.3mf").string();
    std::ofstream(file, std::ios::binary) << zip_of(
        {{"3D/3dmodel.model",
          volumetric_xml(box_object("1", 3) + sphere_function("5", 0.5) +
                             level_set_object("4", "functionid=\"5\" channel=\"shape\" meshid=\"1\""),
                         "<item objectid=\"4\" transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"/>",
                         "unit=\"centimeter\"")}});
    const std::string begin = "kind = \"3mf\"\nfile = \"" + file + "\"\n";
    const Box around{dvec3(-40), dvec3(40)};
    const double ball = 4 * std::acos(-1.0) / 3 * 125;
    const FieldPtr built = part(begin), there = part(begin + "at = [0, 20, 0]\nturn = [0, 0, 90]\n");
    CHECK(volume_in(*built, around, 0.25) == Approx(ball).epsilon(2e-3));
    CHECK(built->value({10, 0, 0}) < 0);
    CHECK(there->value({0, 30, 0}) < 0);
    CHECK(there->value({10, 0, 0}) > 0);
    CHECK(part(begin + "object = \"solid 4\"\n")->value({10, 4.9, 0}) < 0);
    const FieldPtr function = part(begin + "function = \"sphere\"\n");
    CHECK(volume_in(*function, around, 0.25) == Approx(ball).epsilon(2e-3));
    CHECK(function->value({0, 0, 0}) < 0);
    const std::string entry = "[[field]]\nname = \"it\"\n" + begin;
    const auto refusal = [&](const std::string& keys) {
        try {
            build_job(read(entry + keys));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("nothing was refused");
    };
    CHECK_THAT(refusal("function = \"cube\"\n"),
               Catch::Contains("ball.3mf: there is no function \"cube\"; it has 5 \"sphere\""));
    CHECK_THAT(refusal("object = \"7\"\n"),
               Catch::Contains("there is no object \"7\"; it has 1, 4 \"solid 4\""));
    CHECK_THAT(refusal("object = \"4\"\nfunction = \"5\"\n"),
               Catch::Contains("accepted: object or function"));
    CHECK_THAT(refusal("bounds = [[0, 0, 0], [1, 1, 1]]\n"),
               Catch::Contains("accepted: bounds only together with a function"));
}

TEST_CASE("keys that a kind of field does not have, or lacks, are named") {
    const std::string begin = "[[field]]\nname = \"it\"\n";
    CHECK(
        mentions(complaint(begin + "kind = \"sphere\"\n"), "field.radius: missing, required by kind sphere"));
    CHECK(mentions(complaint(begin + "kind = \"sphere\"\nradius = 2\nturn = [0, 0, 9]\n"),
                   "field.turn: does not apply to kind sphere; accepted: radius, at"));
    CHECK(mentions(complaint(begin + "kind = \"box\"\nsize = [1, 2, 3]\nformula = \"x\"\n"),
                   "does not apply to kind box"));
    CHECK(mentions(complaint(begin + "kind = \"capsule\"\nradius = 2\nheight = 3\n"),
                   "field.height: 3 mm is too short for two round ends of radius 2 mm; accepted: 4 mm"));
    CHECK(mentions(complaint(begin + "kind = \"torus\"\nradius = 2\ntube = 2\n"), "field.tube: 2 mm closes"));
    CHECK(mentions(complaint(begin + "kind = \"mesh\"\nfile = \"models/none.stl\"\n"), "none.stl"));
    CHECK(mentions(complaint(begin + "kind = \"ball\"\n"), "accepted: one of formula, vm, mesh, 3mf"));
}

}  // namespace build_fields_test
