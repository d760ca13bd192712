// `lamella homogenize` on every kind of foam, and what it refuses.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "procedural/elasticity/elastic_tensor.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"

namespace command_homogenize_test {

using namespace lamella;
using Json = nlohmann::json;

namespace {

Json stiffness_of_foam(const Folder& folder, const std::string& foam, const std::string& options) {
    write(folder / "foam.toml", "[foam]\n" + foam);
    const Outcome run = run_lamella("homogenize -q --json " + folder / "foam.toml" + " " + options);
    INFO(run.err);
    REQUIRE(run.code == 0);
    return Json::parse(run.out);
}

}  // namespace

TEST_CASE("a random foam is as stiff as was found before", "[elasticity]") {
    // E / Es, nu and density of foams on jittered seeds, one per cell, as computed by another program on 96^3
    // elements (128^3 for the thinnest): single samples of 64 to 125 cells, with which a few percent come in.
    struct Known {
        double t, density, young, poisson;
    };
    const Folder folder;
    for (const Known& known : {Known{0.12, 0.1910, 0.0330, 0.326}, Known{0.20, 0.428, 0.159, 0.271}}) {
        const Json found =
            stiffness_of_foam(folder, fmt::format("cell = 1\nbeam = {}\n", known.t), "--rve 64 --samples 2");
        CHECK(found["density"].get<double>() == Approx(known.density).epsilon(0.03));
        CHECK(found["E"].get<double>() == Approx(known.young).epsilon(0.06));
        CHECK(found["nu"].get<double>() == Approx(known.poisson).epsilon(0.04));
        CHECK(found["E"].get<double>() < found["E_hashin_shtrikman"].get<double>());
        CHECK(found["samples"].size() == 2);
        CHECK(found["samples"][0]["E"] != found["samples"][1]["E"]);
    }
}

TEST_CASE("lattices and periodic surfaces are cubic, and as stiff as theory has them", "[elasticity]") {
    const Folder folder;
    // Thin octets: C11 = p/6, C12 = C44 = p/12 (Deshpande, Fleck, Ashby 2001); nodes make finite ones
    // stiffer.
    const Json octet = stiffness_of_foam(
        folder, "kind = \"lattice\"\nunit_cell = \"octet\"\ncell = 2\nbeam = 0.1\n", "--rve 64");
    const Json c = octet["stiffness"];
    // Computed before by another program, 64^3: share 0.1058, C11 0.02524, C12 0.01275, C44 0.01167.
    CHECK(octet["period_mm"] == 2);
    CHECK(octet["density"].get<double>() == Approx(0.1058).epsilon(0.02));
    CHECK(c[0][0].get<double>() == Approx(0.02524).epsilon(0.04));
    CHECK(c[0][1].get<double>() == Approx(0.01275).epsilon(0.04));
    CHECK(c[3][3].get<double>() == Approx(0.01167).epsilon(0.04));
    for (const std::string kind : {"gyroid", "schwarz-p", "schwarz-d", "neovius"}) {
        const Json sheet =
            stiffness_of_foam(folder, "kind = \"" + kind + "\"\ncell = 3\nwall = 0.3\n", "--rve 32");
        const Json s = sheet["stiffness"];
        INFO(kind << " " << s.dump());
        const double c11 = s[0][0];
        CHECK(s[1][1].get<double>() == Approx(c11).epsilon(0.01));
        CHECK(s[0][3].get<double>() == Approx(0).margin(0.01 * c11));
        CHECK(sheet["K"].get<double>() <
              hashin_shtrikman({1, 1.0 / 3}, sheet["density"].get<double>()).bulk());
    }
}

TEST_CASE("units come from the material, and sizes do not matter", "[elasticity]") {
    const Folder folder;
    const std::string options = "--rve 32 --poisson 0.3 ";
    const Json one = stiffness_of_foam(folder, "cell = 1\nbeam = 0.15\n", options);
    const Json two = stiffness_of_foam(folder, "cell = 2\nbeam = 0.3\n", options + "--young 2000");
    CHECK(two["E"].get<double>() == Approx(2000 * one["E"].get<double>()));
    CHECK(two["period_mm"] == 2 * one["period_mm"].get<double>());
    for (const std::string more :
         {"kind = \"closed\"\ncell = 1\nbeam = 0.1\nwall = 0.1\n",
          "kind = \"k-nearest\"\ncell = 1\nbeam = 0.15\n", "kind = \"kelvin\"\ncell = 1\nbeam = 0.15\n"}) {
        const Json found = stiffness_of_foam(folder, more, options);
        CHECK(found["E"].get<double>() > 0.001);
        CHECK(found["E"].get<double>() < found["density"].get<double>());
    }
    const Outcome text = run_lamella("homogenize --cell 1 --beam 0.15 --rve 32 --poisson 0.3");
    CHECK(text.code == 0);
    CHECK(mentions(text.out, "voronoi foam: a sample of 4 mm, 32 elements along a side"));
    CHECK(mentions(text.out, "Hashin and Shtrikman"));
    CHECK(mentions(text.err, "100 %"));
}

TEST_CASE("foams without a stiffness of their own are refused with what would be right", "[elasticity]") {
    const Folder folder;
    const auto refused = [&](const std::string& recipe, const std::string& options, const std::string& why) {
        write(folder / "foam.toml", recipe);
        const Outcome run = run_lamella("homogenize -q " + folder / "foam.toml" + " " + options);
        INFO(run.err);
        CHECK(run.code == 2);
        CHECK(mentions(run.err, why));
        CHECK(run.out.empty());
    };
    refused("[part]\nshape = \"sphere\"\nradius = 3\n", "", "[foam] is missing");
    refused("[foam]\ncell = \"2 + 0.1 * x\"\nbeam = 0.2\n", "", "foam.cell: it varies in space");
    refused("[foam]\ncell = 2\nbeam = \"0.2 + 0.01 * z\"\n", "", "foam.beam: it varies in space");
    refused("[foam]\ncell = 2\nbeam = 0.2\nstretch = [1, 1, 2]\n", "", "the foam is not periodic");
    refused("[foam]\ncell = 2\nbeam = 0.2\n", "--poisson 0.5", "--poisson: 0.5 is too large");
    refused("[foam]\ncell = 2\nbeam = 0.2\n", "--young 0", "--young: 0 is too small");
    refused("[foam]\ncell = 2\nbeam = 0.2\n", "--rve 2000", "--rve");
}

}  // namespace command_homogenize_test
