// What a recipe may say of loads, anchors and optimisation, and what it is told where it says something else.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "recipe/identity.h"
#include "recipe/recipe_formulas.h"
#include "recipe/settings.h"
#include "tests/app/commands/recipes.h"

namespace recipe_optimize_test {

using namespace lamella;

namespace {

const std::string block =
    "[part]\nshape = \"box\"\nsize = [60, 20, 10]\n"
    "[[field]]\nname = \"hook\"\nkind = \"sphere\"\nradius = 4\n"
    "[[field]]\nname = \"wall\"\nformula = \"x + 29\"\n";
const std::string pull = "[[load]]\nface = \"+x\"\nforce = [0, -10, 0]\n";
const std::string held = "[[anchor]]\nface = \"-x\"\n";
const std::string foam = "[foam]\ncell = 3\nbeam = 0.3\n";
const std::string picture = "kind = \"appearance\"\nimage = \"gears.png\"\nimage_size = 40\n";

Recipe read(const std::string& text) { return recipe_of(block + text, "p.toml"); }

/// Reads a recipe with a load, an anchor and these keys of [optimize].
OptimizeRecipe optimized(const std::string& keys, const std::string& before = "") {
    return *read(before + pull + held + "[optimize]\n" + keys).optimize;
}

/// What the recipe is told; its loads and anchors are as given.
std::string told(const std::string& text) {
    try {
        read(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// What keys of [optimize] are told in a recipe with a load and an anchor.
std::string told_keys(const std::string& keys, const std::string& before = "") {
    return told(before + pull + held + "[optimize]\n" + keys);
}

std::string load(const std::string& rest) { return "[[load]]\n" + rest + "\n"; }
std::string anchor(const std::string& rest) { return "[[anchor]]\n" + rest + "\n"; }
const std::string push = "\nforce = [0, -10, 0]";

}  // namespace

TEST_CASE("a load has a place in one of four ways, and a force or a pressure") {
    const Recipe recipe =
        read(load("field = \"hook\"" + push) +
             load("box = [[-30, -10, -5], [-29, 10, 5]]\npressure = 0.5\ncase = \"wind\"") +
             load("at = [20, 0, 0]\nnormal = [2, 0, 0]" + push + "\nweight = 3\ncase = \"a\"") +
             load("face = \"-z\"" + push));
    REQUIRE(recipe.loads.size() == 4);
    CHECK(recipe.loads[0].field == "hook");
    CHECK(recipe.loads[0].force == dvec3(0, -10, 0));
    CHECK(recipe.loads[0].load_case == "1");
    CHECK(recipe.loads[0].weight == 1);
    CHECK(mentions(recipe.loads[1].where, "p.toml:"));
    CHECK(box_of(recipe.loads[1].box).hi == dvec3(-29, 10, 5));
    CHECK(recipe.loads[1].pressure == 0.5);
    CHECK(recipe.loads[1].load_case == "wind");
    CHECK(recipe.loads[2].at == dvec3(20, 0, 0));
    CHECK(recipe.loads[2].normal == dvec3(2, 0, 0));
    CHECK(recipe.loads[2].weight == 3);
    CHECK(recipe.loads[3].face == "-z");
    CHECK_FALSE(recipe.optimize);
}

TEST_CASE("an anchor holds a place along the axes that it names, by default along all") {
    const Recipe recipe = read(anchor("field = \"wall\"") + anchor("face = \"+y\"\nfix = \"zx\""));
    REQUIRE(recipe.anchors.size() == 2);
    CHECK(recipe.anchors[0].fix == "xyz");
    CHECK(recipe.anchors[1].fix == "zx");
}

TEST_CASE("a place is given, and in one way only") {
    CHECK(mentions(told(load("force = [1, 0, 0]")),
                   "load.field: missing, required by [[load]] (or box or normal or face)"));
    CHECK(mentions(told(anchor("fix = \"x\"")), "anchor.field: missing, required by [[anchor]]"));
    CHECK(mentions(told(load("field = \"hook\"\nface = \"+x\"" + push)),
                   "p.toml:13: load.face: conflicts with p.toml:12: load.field; accepted: only one of field, "
                   "box, normal, face"));
    CHECK(mentions(told(load("at = [0, 0, 0]\nnormal = [1, 0, 0]\nface = \"+x\"" + push)),
                   "load.face: conflicts with p.toml:13: load.normal"));
    CHECK(mentions(told(anchor("field = \"hook\"\nbox = [[0, 0, 0], [1, 1, 1]]")),
                   "anchor.box: conflicts with p.toml:12: anchor.field"));
}

TEST_CASE("a plane has a point and a direction") {
    CHECK(mentions(told(load("at = [0, 0, 0]" + push)), "load.normal: missing, required by a plane"));
    CHECK(mentions(told(load("normal = [0, 0, 1]" + push)), "load.at: missing, required by a plane"));
    CHECK(mentions(told(load("at = [0, 0, 0]\nnormal = [0, 0, 0]" + push)),
                   "p.toml:13: load.normal: has no direction"));
}

TEST_CASE("a box names its lower corner first, and a face is one of six") {
    CHECK(mentions(told(anchor("box = [[0, 0, 0], [1, -1, 1]]")), "anchor.box: a coordinate of the first"));
    CHECK(mentions(
        told(anchor("face = \"x\"")),
        "anchor.face: \"x\" is unknown, did you mean `-x`?; accepted: one of -x, +x, -y, +y, -z, +z"));
}

TEST_CASE("a load or an anchor in an unknown field is told the known ones") {
    CHECK(mentions(told(load("field = \"hok\"" + push)),
                   "p.toml:12: load.field: no [[field]] is named \"hok\", did you mean `hook`?; accepted: "
                   "hook, wall"));
    CHECK(mentions(told(anchor("field = \"wal\"")), "anchor.field: no [[field]] is named \"wal\""));
}

TEST_CASE("a load has either a force or a pressure, and that is not zero") {
    CHECK(mentions(told(load("face = \"+x\"")), "load.force: missing, required by [[load]] (or pressure)"));
    CHECK(
        mentions(told(load("face = \"+x\"\npressure = 1" + push)), "accepted: only one of force, pressure"));
    CHECK(mentions(told(load("face = \"+x\"\nforce = [0, 0, 0]")), "p.toml:13: load.force: is no force"));
    CHECK(mentions(told(load("face = \"+x\"\npressure = 0")), "load.pressure: 0 is too small"));
}

TEST_CASE("loads of one case have one weight") {
    const std::string first = load("face = \"+x\"\ncase = \"a\"\nweight = 2" + push);
    CHECK(told(first + first + load("face = \"+x\"\ncase = \"b\"" + push)).empty());
    CHECK(mentions(told(first + load("face = \"+y\"\ncase = \"a\"\nweight = 3" + push)),
                   "p.toml:19: load.weight: 3 differs from 2 (p.toml:14: load.weight), of a load of the same "
                   "case \"a\"; accepted: one weight for all loads of a case"));
    CHECK(mentions(told(first + load("face = \"+y\"\ncase = \"a\"" + push)), "load.weight: 1 differs from"));
}

TEST_CASE("axes are letters x, y and z, each at most once") {
    for (const std::string wrong : {"w", "xx", "x,y", "XY"}) {
        CAPTURE(wrong);
        CHECK(
            mentions(told(anchor("face = \"-x\"\nfix = \"" + wrong + "\"")),
                     "anchor.fix: the letters \"" + wrong + "\" do not name axes; accepted: one or more of"));
        CHECK(mentions(told_keys("symmetry = \"" + wrong + "\"\n"),
                       "optimize.symmetry: the letters \"" + wrong + "\""));
    }
    CHECK(optimized("symmetry = \"yx\"\n").symmetry == "yx");
}

TEST_CASE("the section alone asks for the stiffest shape of half the volume") {
    const OptimizeRecipe optimize = optimized("");
    CHECK(optimize.kind == OptimizeKind::stiffness);
    CHECK(optimize.result == OptimizeResult::solid);
    CHECK(optimize.method == OptimizeMethod::oc);
    CHECK(optimize.volume == 0.5);
    CHECK(optimize.dimensions == 3);
    CHECK(optimize.gravity == dvec3(0));
    CHECK_FALSE(read(pull + held).optimize);
}

TEST_CASE("an optimisation needs a load and an anchor") {
    CHECK(mentions(told(held + "[optimize]\n"),
                   "optimize: nothing loads the body; accepted: a [[load]] or optimize.gravity"));
    CHECK(mentions(told(pull + "[optimize]\n"), "optimize: nothing holds the body; accepted: one or more"));
    CHECK(told("[material]\ndensity = 1\n" + held + "[optimize]\ngravity = [0, 0, -9.81]\n").empty());
}

TEST_CASE("anchors together hold the body along each axis in use") {
    const std::string x = anchor("face = \"-x\"\nfix = \"x\""), y = anchor("face = \"+x\"\nfix = \"y\"");
    CHECK(
        mentions(told(pull + x + "[optimize]\n"),
                 "p.toml:17: optimize: the body is not held along y and z; accepted: an [[anchor]] whose fix "
                 "has y and z"));
    CHECK(mentions(told(pull + x + y + "[optimize]\n"), "the body is not held along z;"));
    CHECK(told(pull + x + y + "[optimize]\ndimensions = 2\n").empty());
    CHECK(mentions(told(pull + y + "[optimize]\ndimensions = 2\n"), "the body is not held along x;"));
}

TEST_CASE("a plate bears no load across it, and nothing varies across it") {
    const std::string plate = "[optimize]\ndimensions = 2\n";
    CHECK(
        mentions(told(load("face = \"+x\"\nforce = [0, 1, -10]") + held + plate),
                 "load.force: a plate bears no load along z with optimize.dimensions = 2; accepted: 0 along "
                 "z, or three dimensions"));
    CHECK(mentions(told(load("face = \"+z\"\npressure = 1") + held + plate),
                   "load.face: a plate bears no load along z"));
    CHECK(mentions(told_keys("dimensions = 2\ngravity = [0, 0, -1]\n", "[material]\nname = \"pla\"\n"),
                   "optimize.gravity: a plate bears no load along z"));
    CHECK(mentions(told_keys("dimensions = 2\noverhang = true\n"),
                   "optimize.overhang: layers are all the same"));
    CHECK(
        mentions(told_keys("dimensions = 2\nsymmetry = \"xz\"\n"), "optimize.symmetry: there is no middle"));
    CHECK(optimized("dimensions = 2\nsymmetry = \"x\"\noverhang = false\n").dimensions == 2);
}

TEST_CASE("of two ways to say one thing only one is accepted") {
    CHECK(mentions(
        told_keys("volume = 0.4\nmass = 10\n", "[material]\nname = \"pla\"\n"),
        "optimize.mass: conflicts with p.toml:19: optimize.volume; accepted: only one of volume, mass"));
    CHECK(mentions(told_keys("element = 1\nelements = 64\n"), "accepted: only one of element, elements"));
    CHECK(mentions(told_keys("radius = 2\nmember = 3\ngap = 3\n"), "accepted: only one of radius, member"));
    CHECK(mentions(told_keys("radius = 2\ngap = 3\n"), "accepted: only one of radius, gap"));
    const OptimizeRecipe both = optimized("member = 3\ngap = 2\nelements = 32\n");
    CHECK(both.member == 3);
    CHECK(both.gap == 2);
    CHECK(both.elements == 32);
}

TEST_CASE("least sizes need a projection") {
    CHECK(mentions(
        told_keys("member = 3\nsharpness = 0\n"),
        "optimize.sharpness: 0 is no projection, without which p.toml:17: optimize.member has no effect"));
    CHECK(optimized("radius = 3\nsharpness = 0\n").sharpness == 0);
}

TEST_CASE("a mass and gravity need the material's density, and nothing else needs a material") {
    CHECK(mentions(told_keys("mass = 20\n"),
                   "p.toml:17: optimize.mass: needs the material's density; accepted: "
                   "material.name / --material or material.density"));
    CHECK(mentions(told_keys("gravity = [0, 0, -9.81]\n", "[material]\nyoung = 2000\n"),
                   "optimize.gravity: needs the material's density"));
    CHECK(mentions(told_keys("mass = 20\n", "[material]\nname = \"plaa\"\n"),
                   "material.name: \"plaa\" is unknown, did you mean `pla`?"));
    CHECK(optimized("mass = 20\n", "[material]\nname = \"pla\"\n").mass == 20);
    CHECK(optimized("mass = 20\n", "[material]\ndensity = 1.1\n").mass == 20);
}

TEST_CASE("an appearance has a picture and its width, and is found by moving asymptotes") {
    CHECK(mentions(told_keys("kind = \"appearance\"\nimage = \"a.png\"\n"),
                   "optimize.image_size: missing, required by kind appearance"));
    CHECK(mentions(told_keys("kind = \"appearance\"\nimage_size = 10\n"),
                   "optimize.image: missing, required by kind appearance"));
    CHECK(mentions(told_keys(picture + "method = \"oc\"\n"),
                   "p.toml:20: optimize.method: \"oc\" cannot bound the compliance"));
    CHECK(mentions(told_keys(picture + "volume = 0.3\nvolume_min = 0.4\n"),
                   "optimize.volume_min: 0.4 is more than p.toml:20: optimize.volume, 0.3"));
    const auto is_refused = [](const std::string& key, const std::string& why) {
        return mentions(told_keys(picture + key + "\n"), why + " with optimize.kind = \"appearance\"");
    };
    CHECK(is_refused("dimensions = 3", "optimize.dimensions: a picture is one of a plate, which has two"));
    CHECK(is_refused("member = 2", "optimize.member: there is no least size"));
    CHECK(is_refused("gap = 2", "optimize.gap: there is no least size"));
    CHECK(is_refused("tolerance = 0.1", "optimize.tolerance: all steps are taken"));
    const OptimizeRecipe optimize = optimized(picture + "volume_min = 0.4\nlevels = 2\ninvert = true\n");
    CHECK(optimize.kind == OptimizeKind::appearance);
    CHECK(optimize.method == OptimizeMethod::mma);
    CHECK(optimize.dimensions == 2);
    CHECK(optimize.image == "gears.png");
    CHECK(optimize.levels == 2);
    CHECK(optimize.neighbourhood == 14);
}

TEST_CASE("keys of an appearance are refused without it") {
    for (const std::string key :
         {"image = \"a.png\"", "image_size = 3", "invert = true", "threshold = 0.3", "neighbourhood = 8",
          "exponent = 2", "spread = 1", "levels = 2", "volume_min = 0.1"}) {
        CAPTURE(key);
        CHECK(mentions(told_keys(key + "\n"), "optimize." + key.substr(0, key.find(' ')) +
                                                  ": does not apply to kind stiffness; accepted: kind "
                                                  "appearance"));
    }
}

TEST_CASE("a search for the lightest part has a compliance to keep, and may fill the whole part") {
    CHECK(mentions(told_keys("kind = \"lightness\"\n"),
                   "optimize.compliance: missing, required by kind lightness"));
    CHECK(mentions(told_keys("compliance = 2\n"), "optimize.compliance: does not apply to kind stiffness"));
    CHECK(mentions(told_keys("kind = \"lightness\"\ncompliance = 2\ngravity = [0, 0, -9]\n"),
                   "optimize.gravity: with optimize.kind = \"lightness\""));
    CHECK(optimized("kind = \"lightness\"\ncompliance = 2\n").volume == OptimizeRecipe::whole_part);
    CHECK(optimized("kind = \"lightness\"\ncompliance = 2\nvolume = 0.4\n").volume == 0.4);
}

TEST_CASE("a driven number is one that the foam has") {
    CHECK(mentions(told_keys("result = \"cell\"\n"),
                   "optimize.result: \"cell\" varies the part's foam, and there is none; accepted: a section "
                   "[foam] as well, or solid"));
    CHECK(
        mentions(told_keys("result = \"beam\"\n", "[foam]\nkind = \"gyroid\"\ncell = 4\nwall = 0.5\n"),
                 "optimize.result: \"beam\" does not apply to foam.kind gyroid; accepted: foam.kind = one of "
                 "voronoi, kelvin, k-nearest, lattice, or solid"));
    CHECK(optimized("result = \"beam\"\n", foam).result == OptimizeResult::beam);
    CHECK(optimized("result = \"cell\"\n", "[foam]\nkind = \"gyroid\"\ncell = 4\nwall = 0.5\n").result ==
          OptimizeResult::cell);
}

TEST_CASE("a driven foam has a stiffness law, which says what its number is worth") {
    CHECK(mentions(
        told_keys("result = \"beam\"\n", "[foam]\nkind = \"kelvin\"\njitter = 0.2\ncell = 3\nbeam = 0.3\n"),
        "optimize.result: there is no stiffness law for this foam (kelvin/jitter=0.2); accepted: "
        "foam.law / --foam-law with a file"));
    CHECK(mentions(told_keys("result = \"cell\"\n", foam + "stretch = [1, 1, 2]\n"),
                   "foam.stretch: there is no stiffness law for stretched cells"));
    const std::string closed = "[foam]\nkind = \"closed\"\ncell = 3\nbeam = 0.2\n";
    CHECK(mentions(told_keys("result = \"beam\"\n", closed + "wall = 0.2\n"),
                   "the law of closed cells requires uniform beams, walls and windows"));
    CHECK(mentions(told_keys("result = \"cell\"\n", closed + "wall = \"0.2 + 0*x\"\n"),
                   "the law of closed cells requires uniform beams, walls and windows"));
    CHECK(told_keys("result = \"cell\"\n", closed + "wall = 0.2\n").empty());
    CHECK(mentions(told_keys("result = \"cell\"\n", foam + "law = \"nowhere.csv\"\n"), "nowhere.csv"));
}

TEST_CASE("a driven number is not also determined by a modulus") {
    const std::string stiff = "[foam]\nbeam = 0.3\nmodulus = 10\n[material]\nname = \"pla\"\n";
    CHECK(mentions(told_keys("result = \"cell\"\n", stiff),
                   "optimize.result: \"cell\" conflicts with p.toml:13: foam.modulus"));
    CHECK(told_keys("", stiff).empty());
}

TEST_CASE("all mistakes of a problem are told at once") {
    const std::string all =
        told(load("field = \"hok\"" + push) + load("face = \"-y\"\nforce = [0, 0, 0]") +
             anchor("field = \"wal\"\nfix = \"x\"") + "[optimize]\nmass = 3\nresult = \"cell\"\n");
    for (const std::string part :
         {"load.field: no [[field]]", "load.force: is no force", "anchor.field: no [[field]]",
          "not held along y and z", "optimize.mass: needs", "optimize.result: \"cell\" varies"}) {
        CAPTURE(part);
        CHECK(mentions(all, part));
    }
}

TEST_CASE("a field that only a load or an anchor takes is used") {
    const std::string places = load("field = \"hook\"" + push) + anchor("field = \"wall\"");
    CHECK(unused_entries(read(places)).empty());
    CHECK(mentions(unused_entries(read(pull)), "`hook`"));
}

TEST_CASE("loads, anchors and what is optimised are part of the job's identity") {
    const std::string all = pull + held + "[optimize]\n";
    const std::string plain = job_identity(read("")), whole = job_identity(read(all));
    CHECK(plain != job_identity(read(pull)));
    CHECK(plain != job_identity(read(held)));
    CHECK(whole != plain);
    CHECK(whole == job_identity(read(all + "volume = 0.5\n")));
    for (const std::string key : {"volume = 0.4", "elements = 32", "symmetry = \"x\"", "overhang = true",
                                  "method = \"mma\"", "sharpness = 8"}) {
        CAPTURE(key);
        CHECK(job_identity(read(all + key + "\n")) != whole);
    }
    CHECK(job_identity(read(pull + "weight = 2\n" + held + "[optimize]\n")) != whole);
    CHECK(job_identity(read(pull + held + "fix = \"yxz\"\n[optimize]\n")) != whole);
}

TEST_CASE("the bytes of a picture are part of the job's identity") {
    const std::string path = (std::filesystem::temp_directory_path() / "lamella_optimize.png").string();
    const auto with = [&](const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
        return job_identity(read(
            pull + held + "[optimize]\nkind = \"appearance\"\nimage_size = 9\nimage = \"" + path + "\"\n"));
    };
    const std::string first = with("one");
    CHECK(with("two") != first);
    CHECK(with("one") == first);
    std::filesystem::remove(path);
}

TEST_CASE("flags of an optimisation replace the recipe's keys") {
    RecipeDraft draft;
    draft.read_text(block + pull + held + "[optimize]\nvolume = 0.4\n", "p.toml");
    draft.assign_flag(*find_setting("optimize", "volume"), "0.3");
    draft.assign_flag(*find_setting("optimize", "symmetry"), "y");
    const Recipe recipe = draft.finish();
    CHECK(recipe.optimize->volume == 0.3);
    CHECK(recipe.optimize->symmetry == "y");
}

}  // namespace recipe_optimize_test
