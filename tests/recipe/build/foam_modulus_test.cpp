// A modulus asked for becomes cells or members, is reported with the job, and is what homogenisation finds.
#include "recipe/build/foam_modulus.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "procedural/elasticity/elastic_tensor.h"
#include "procedural/elasticity/field_sample.h"
#include "procedural/elasticity/homogenization.h"
#include "recipe/build/build_job.h"
#include "recipe/recipe_draft.h"
#include "recipe/shipped_texts.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"

namespace foam_modulus_test {

using namespace lamella;
using Json = nlohmann::json;

namespace {

const std::string bar = "[part]\nshape = \"box\"\nsize = [40, 12, 12]\n";
const std::string stuff = "[material]\nyoung = 2000\n";

Json info_of(const Folder& folder, const std::string& recipe) {
    write(folder / "part.toml", recipe);
    const Outcome run = run_lamella("info --json " + folder / "part.toml");
    INFO(run.err);
    REQUIRE(run.code == 0);
    return Json::parse(run.out);
}

void check_refused(const Folder& folder, const std::string& recipe, const std::string& why) {
    write(folder / "part.toml", recipe);
    const Outcome run = run_lamella("info " + folder / "part.toml");
    INFO(recipe << run.err);
    CHECK(run.code == 2);
    CHECK(mentions(run.err, why));
}

void check_refused_table(const Folder& folder) {
    write(folder / "graded.toml",
          "[foam]\nkind = \"closed\"\ncell = 2\nbeam = 0.2\nwall = \"0.2 + 0.01 * x\"\n");
    const Outcome run = run_lamella("homogenize --table " + folder / "graded.toml");
    CHECK(run.code == 2);
    CHECK(mentions(run.err, "foam.wall: it varies in space"));
    // Members that fill their cells are told of before anything is computed.
    const Outcome full =
        run_lamella("homogenize --table --foam schwarz-d --wall 0.1 --cell 1 --ratios 0.1,0.9");
    CHECK(full.code == 2);
    CHECK(mentions(full.err, "a ratio of 0.9: foam (schwarz-d)"));
    CHECK_FALSE(mentions(full.err, "%"));
}

}  // namespace

TEST_CASE("laws that ship stiffen with the ratio, and stay below the bounds", "[elasticity]") {
    const auto laws = read_foam_laws(shipped_foam_laws(), "foam_laws.csv");
    CHECK(laws.size() >= 10);
    for (const FoamLawTable& law : laws) {
        INFO(law.foam);
        CHECK_NOTHROW(FoamLaw(law, 0.3));
        CHECK(law.points.size() >= 4);
        for (const FoamLawPoint& point : law.points) {
            CHECK(point.young < point.density);
            if (point.anisotropy < 0.05)
                CHECK(point.young < 1.01 * hashin_shtrikman({1, law_poisson}, point.density).young);
            CHECK(point.low_factor == Approx(1).epsilon(0.15));
            CHECK(point.high_factor == Approx(1).epsilon(0.25));
        }
    }
}

TEST_CASE("the shipped law of random foam is what others computed", "[elasticity]") {
    // E / Es and nu on 96^3 to 128^3 elements by another program, 64 to 125 cells.
    struct Known {
        double ratio, young, poisson;
    };
    const auto laws = read_foam_laws(shipped_foam_laws(), "foam_laws.csv");
    const auto voronoi =
        std::find_if(laws.begin(), laws.end(), [](const auto& l) { return l.foam == "voronoi"; });
    REQUIRE(voronoi != laws.end());
    const FoamLaw law(*voronoi, law_poisson);
    for (const Known& known :
         {Known{0.07, 0.0059, 0.397}, Known{0.10, 0.0191, 0.351}, Known{0.12, 0.0330, 0.326},
          Known{0.14, 0.0543, 0.308}, Known{0.20, 0.159, 0.271}}) {
        CHECK(law.at(known.ratio).young == Approx(known.young).epsilon(0.06));
        CHECK(law.at(known.ratio).poisson == Approx(known.poisson).epsilon(0.04));
    }
    for (const FoamLawPoint& point : voronoi->points) {
        CHECK(point.anisotropy < 0.05);
        CHECK(point.samples * 64 >= 200);
    }
}

TEST_CASE("a foam made for a modulus has it when it is homogenised", "[elasticity][slow]") {
    const Folder folder;
    for (const double asked : {5.0, 100.0}) {
        for (const std::string& size : {std::string("beam = 0.3\n"), std::string("cell = 3\n")}) {
            write(folder / "foam.toml", fmt::format("{}[foam]\nmodulus = {}\n{}", stuff, asked, size));
            // Four elements per beam radius at least: stiff foams have thick beams.
            const std::string elements = asked > 50 ? "64" : "96";
            const Outcome run =
                run_lamella("homogenize -q --json --rve " + elements + " " + folder / "foam.toml");
            INFO(run.err);
            REQUIRE(run.code == 0);
            CHECK(Json::parse(run.out)["E"].get<double>() == Approx(asked).epsilon(0.1));
            // A sample holds 64 cells, also where a modulus decides how large these are.
            const FoamModulus law(FoamLaw(read_foam_laws(shipped_foam_laws(), "").front(), law_poisson),
                                  2000);
            const double cell = size.starts_with("cell") ? 3 : 0.3 / law.ratio_of(asked);
            CHECK(Json::parse(run.out)["period_mm"].get<double>() == Approx(4 * cell));
        }
    }
}

TEST_CASE("a modulus that varies is predicted as it is asked for, and told with the job", "[elasticity]") {
    const Folder folder;
    const std::string foam = "[foam]\nbeam = 0.3\nmodulus = \"40 + x\"\n";
    const Json info = info_of(folder, bar + stuff + foam);
    const Json& modulus = info["modulus"];
    CHECK(modulus["asked_MPa"][0].get<double>() == Approx(20).margin(1));
    CHECK(modulus["asked_MPa"][1].get<double>() == Approx(60).margin(1));
    CHECK(modulus["predicted_MPa"][0].get<double>() == Approx(modulus["asked_MPa"][0].get<double>()));
    CHECK(modulus["softer_share"] == 0);
    CHECK(modulus["stiffer_share"] == 0);
    CHECK(modulus["band"].get<double>() > 0.005);
    CHECK(modulus["band"].get<double>() < 0.2);
    const Outcome png = run_lamella("slice " + folder / "part.toml" +
                                    " --layers 0:2 --printer generic-4k -o " + folder / "masks");
    CHECK(png.code == 0);
    CHECK(mentions(png.err, "modulus: the foam gets 20"));
    CHECK(mentions(contents(folder / "masks/job.json"), "modulus: the foam gets 20"));
    const Outcome sl1 = run_lamella("slice -q " + folder / "part.toml" +
                                    " --layers 0:2 --printer prusa-sl1s -o " + folder / "a.sl1s");
    CHECK(sl1.code == 0);
    CHECK(mentions(contents(folder / "a.sl1s"), "material_notes = modulus: the foam gets 20"));
    const Outcome gcode =
        run_lamella("slice -q " + folder / "part.toml" +
                    " --layers 0:2 --layer-height 0.2 --printer marlin -o " + folder / "a.gcode");
    CHECK(gcode.code == 0);
    CHECK(mentions(contents(folder / "a.gcode"), "; modulus: the foam gets 20"));
}

TEST_CASE("what cannot be had is kept in range, counted and painted", "[elasticity]") {
    const Folder folder;
    // A quarter of the bar asks for less than any printable foam has, a quarter for more.
    const std::string foam =
        "[foam]\nbeam = 0.3\ncell_min = 1.5\ncell_max = 5\nmodulus = \"max(0.1, 40 + 8 * x)\"\n";
    const Json info = info_of(folder, bar + stuff + foam);
    const FoamModulus law(FoamLaw(read_foam_laws(shipped_foam_laws(), "").front(), law_poisson), 2000);
    const double least = law.modulus_of(0.3 / 5), most = law.modulus_of(0.3 / 1.5);
    const double softer = std::max(0.0, (40 + 8 * 20 - most) / 320), stiffer = (least - (40 - 8 * 20)) / 320;
    CHECK(info["modulus"]["stiffer_share"].get<double>() == Approx(stiffer).margin(0.03));
    CHECK(info["modulus"]["softer_share"].get<double>() == Approx(softer).margin(0.03));
    CHECK(info["modulus"]["predicted_MPa"][0].get<double>() == Approx(least).epsilon(0.01));
    const Outcome picture = run_lamella("preview " + folder / "part.toml" + " --paint modulus --size 64 -o " +
                                        folder / "stiff.png");
    CHECK(picture.code == 0);
    CHECK(mentions(picture.err, "red where the foam gets softer than asked, white where stiffer"));
    const Outcome none =
        run_lamella("preview --shape sphere --shape-radius 5 --paint modulus -o " + folder / "x.png");
    CHECK(none.code == 2);
    CHECK(mentions(none.err, "--paint modulus: the foam's modulus is unknown"));
}

TEST_CASE("sizes beyond the law are told of", "[elasticity]") {
    const Folder folder;
    const Json info = info_of(folder, bar + stuff + "[foam]\ncell = 20\nbeam = 0.1\n");
    CHECK(mentions(info["modulus"]["notes"][1].get<std::string>(), "thinner or thicker than its law knows"));
    CHECK(info_of(folder, bar + stuff + "[foam]\ncell = 3\nbeam = 0.3\n")["modulus"]["notes"].size() == 1);
}

TEST_CASE("a region can be stiffer than the rest", "[elasticity]") {
    const Folder folder;
    const Json info =
        info_of(folder, bar + stuff +
                            "[foam]\nbeam = 0.3\nmodulus = 10\n[[field]]\nname = \"end\"\nkind = \"box\"\n"
                            "size = [10, 12, 12]\nat = [15, 0, 0]\n[[region]]\nfield = \"end\"\nmake = "
                            "\"foam\"\nmodulus = 60\n");
    CHECK(info["modulus"]["predicted_MPa"][0].get<double>() == Approx(10));
    CHECK(info["modulus"]["predicted_MPa"][1].get<double>() == Approx(60));
}

TEST_CASE("compression tests bend the law, with a band of their own", "[elasticity]") {
    const Folder folder;
    write(folder / "tests.csv", "cell,beam,modulus\n3,0.3,30\n3,0.24,14\n3,0.4,78\n2,0.2,33\n");
    const Json info =
        info_of(folder, bar +
                            "[material]\nyoung = 2000\ntests = \"tests.csv\"\n[foam]\nbeam = 0.3\n"
                            "cell = 3\n");
    CHECK(info["modulus"]["fit"]["tests"] == 4);
    CHECK(info["modulus"]["predicted_MPa"][0].get<double>() == Approx(31).margin(3));
    CHECK(mentions(info["modulus"]["notes"][0].get<std::string>(), "fitted to 4 tests"));
    for (const char* row : {"3,0.3\n", "3,0.3,inf\n", "1e-320,0.3,30\n"}) {
        write(folder / "tests.csv", row);
        check_refused(folder,
                      bar + "[material]\nyoung = 2000\ntests = \"tests.csv\"\n[foam]\nbeam = 0.3\ncell = 3\n",
                      "tests.csv:1: not three positive numbers");
    }
}

TEST_CASE("a law of one's own is found by what shapes the foam", "[elasticity][slow]") {
    const Folder folder;
    const std::string foam = "[foam]\nkind = \"kelvin\"\njitter = 0.3\nbeam = 0.3\nmodulus = 60\n";
    check_refused(folder, bar + stuff + foam, "there is no stiffness law for this foam (kelvin/jitter=0.3)");
    const Outcome table = run_lamella(
        "homogenize -q --foam kelvin --jitter 0.3 --cell 1 --beam 0.1 --table --rve 32 "
        "--samples 1 --ratios 0.1,0.18 -o " +
        folder / "mine.csv" + " --plot " + folder / "mine.svg");
    REQUIRE(table.code == 0);
    // Sizes do not matter, nor does a modulus that would choose them.
    const Outcome again = run_lamella(
        "homogenize -q --foam kelvin --jitter 0.3 --cell 2 --modulus 5 --material pla --table --rve 32 "
        "--samples 1 --ratios 0.1,0.18");
    CHECK(again.out == contents(folder / "mine.csv"));
    check_refused_table(folder);
    CHECK(mentions(contents(folder / "mine.svg"), "the foam's law"));
    const Json info = info_of(folder, bar + stuff + foam + "law = \"mine.csv\"\n");
    CHECK(info["modulus"]["predicted_MPa"][0].get<double>() == Approx(60));
}

TEST_CASE("a modulus without what it needs is refused with what would be right", "[elasticity]") {
    const Folder folder;
    check_refused(folder, bar + stuff + "[foam]\nmodulus = 20\n",
                  "determines cells or members from the other one, and neither is given");
    check_refused(folder, bar + stuff + "[foam]\nmodulus = 20\ncell = 2\nbeam = 0.2\n",
                  "conflicts with the given cells and members, which determine the modulus; accepted: "
                  "foam.modulus with foam.cell or foam.beam, not both");
    check_refused(folder, bar + "[foam]\nmodulus = 20\nbeam = 0.2\n",
                  "material.name / --material or material.young");
    check_refused(folder, bar + stuff + "[foam]\nmodulus = 20\nbeam = 0.2\nstretch = [1, 1, 2]\n",
                  "there is no stiffness law for stretched cells");
    check_refused(folder, bar + stuff + "[foam]\nkind = \"closed\"\nmodulus = 20\ncell = 2\nwall = 0.2\n",
                  "determines the size of closed cells from their beams and walls");
    check_refused(folder, bar + "[material]\nname = \"plaa\"\n[foam]\nmodulus = 20\nbeam = 0.2\n",
                  "material.name: \"plaa\" is unknown, did you mean `pla`?");
    check_refused(folder, bar + stuff + "[foam]\nmodulus = 20\nbeam = \"cell / 10\"\n", "cell");
    check_refused(folder, bar + "[foam]\ncell = 2\nbeam = 0.2\nlaw = \"x.csv\"\n", "has no effect without");
}

TEST_CASE("nothing is predicted of a foam that no one law holds for", "[elasticity]") {
    const Folder folder;
    for (const std::string foam :
         {"[foam]\ncell = 3\nbeam = 0.3\nstretch = [1, 1, 2]\n",
          "[foam]\nkind = \"closed\"\ncell = 3\nbeam = 0.3\nwall = \"0.3 + 0.01 * x\"\n",
          "[foam]\nkind = \"closed\"\ncell = 3\nbeam = 0.3\nwall = 0.2\n"}) {
        CHECK_FALSE(info_of(folder, bar + stuff + foam).contains("modulus"));
    }
    CHECK(info_of(folder, bar + stuff + "[foam]\nkind = \"closed\"\ncell = 3\nbeam = 0.3\nwall = 0.3\n")
              .contains("modulus"));
    check_refused(
        folder,
        bar + stuff + "[foam]\nkind = \"closed\"\nbeam = 0.3\nwall = \"0.3 + 0.01 * x\"\nmodulus = 50\n",
        "the law of closed cells requires uniform beams, walls and windows");
    write(folder / "tests.csv", "3,0.3,30\n");
    check_refused(
        folder,
        bar +
            "[material]\nyoung = 2000\ntests = \"tests.csv\"\n[foam]\nkind = \"kelvin\"\njitter = 0.4\n"
            "cell = 3\nbeam = 0.3\n",
        "material.tests / --material-tests: there is no stiffness law for this foam");
}

TEST_CASE("materials are listed with their sources, and one's own are read", "[elasticity]") {
    const Outcome list = run_lamella("materials");
    CHECK(list.code == 0);
    for (const char* name : {"pla", "petg", "abs", "tpu-95a", "pa12-sls", "resin-durable", "data sheet"})
        CHECK(mentions(list.out, name));
    const Folder folder;
    const Outcome toml = run_lamella("materials --toml");
    write(folder / "mine.toml", toml.out + "\n[mine]\nyoung = 500\npoisson = 0.4\n");
    CHECK(mentions(run_lamella("materials --table " + folder / "mine.toml").out, "mine"));
    const Json info =
        info_of(folder, bar +
                            "[material]\nname = \"mine\"\ntable = \"mine.toml\"\n[foam]\nmodulus = 20\n"
                            "beam = 0.3\n");
    CHECK(info["modulus"]["material"] == "mine, 500 MPa");
    write(folder / "mine.toml", "[mine]\nyoung = -3\n");
    check_refused(
        folder,
        bar + "[material]\nname = \"mine\"\ntable = \"mine.toml\"\n[foam]\nmodulus = 20\nbeam = 0.3\n",
        "mine.toml:2: young is out of range");
    write(folder / "mine.toml", "[mine]\nyoung = 3\nweight = 2\n");
    check_refused(
        folder,
        bar + "[material]\nname = \"mine\"\ntable = \"mine.toml\"\n[foam]\nmodulus = 20\nbeam = 0.3\n",
        "mine.toml:3: `weight` is not a key of a material");
}

TEST_CASE("the mass is told where the density is known", "[elasticity]") {
    const Folder folder;
    const Outcome run = run_lamella(
        "slice --json --shape box --shape-size 10,10,10 --density 1.2 --layer-height 0.5 "
        "--printer generic-4k -o " +
        folder / "masks");
    REQUIRE(run.code == 0);
    CHECK(Json::parse(run.out)["mass_g"].get<double>() == Approx(1.2).epsilon(0.001));
}

namespace {

/// A piece of a structure and its mirror images along all three axes: a sample that repeats.
ElementMask mirrored(const ElementMask& piece) {
    ElementMask whole{piece.size * 2, std::vector<std::uint8_t>(8 * piece.present.size())};
    const auto folded = [](int i, int n) { return i < n ? i : 2 * n - 1 - i; };
    for (int z = 0; z < whole.size.z; ++z) {
        for (int y = 0; y < whole.size.y; ++y) {
            for (int x = 0; x < whole.size.x; ++x) {
                whole.present[whole.place(x, y, z)] =
                    piece.at(folded(x, piece.size.x), folded(y, piece.size.y), folded(z, piece.size.z));
            }
        }
    }
    return whole;
}

}  // namespace

TEST_CASE("a bar that is to stiffen evenly does, piece by piece", "[elasticity][slow]") {
    RecipeDraft draft;
    draft.require_body(false);
    draft.read_text(stuff + "[foam]\nbeam = 0.3\nmodulus = \"20 + 1.5 * x\"\n", "bar.toml");
    const double side = 14;
    const BuiltFoam foam = build_foam_alone(draft.finish(), {dvec3(0), {3 * side, side, side}});
    for (int piece = 0; piece < 3; ++piece) {
        const dvec3 corner{piece * side, 0, 0};
        const ElementMask sample = sample_field(*foam.field, {corner, corner + dvec3(side)}, 44);
        const double found =
            closest_isotropic(homogenize(mirrored(sample), {2000, law_poisson}, {1e-3}).stiffness).young;
        const double asked = 20 + 1.5 * (piece + 0.5) * side;
        CHECK(found == Approx(asked).epsilon(0.15));
    }
}

}  // namespace foam_modulus_test
