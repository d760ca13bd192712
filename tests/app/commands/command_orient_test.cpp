// `lamella orient`: its list, and what it writes into recipes.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/mentions.h"

namespace command_orient_test {

using namespace lamella;

namespace {

using Json = nlohmann::json;

/// A plate on a stem.
const std::string table =
    "# a table\n[part]  # of wood\nfield = \"table\"\nturn = [10, 0, 0]  # by hand\n\n[[field]]\nname = "
    "\"table\"\nformula = \"min(max(abs(x) - 20, abs(y) - 15, abs(z - 11) - 1), max(abs(x) - 3, abs(y) - 3, "
    "abs(z "
    "- 5.5) - 5.5))\"\nbounds = [[-20, -15, 0], [20, 15, 12]]\n\n[layers]\nheight = 0.2\n";

}  // namespace

TEST_CASE("orient lists orientations and writes one of them into the recipe", "[orientation]") {
    const Folder folder;
    const std::string recipe = folder / "table.toml";
    write(recipe, table);
    const Outcome listed = run_lamella("orient --json --count 4 --plan 3 " + recipe);
    REQUIRE(listed.code == 0);
    const Json report = Json::parse(listed.out);
    REQUIRE(report["best"].size() == 4);
    CHECK(report["best"][0]["supports_mm3"].get<double>() < 1);
    CHECK(report["best"][0]["lay_on"][2].get<double>() == Approx(1).margin(1e-5));
    CHECK(report["best"][3]["supports_mm3"].is_null());
    CHECK(report["now"]["estimated_supports_mm3"].get<double>() > 100);
    CHECK(report["best"][0]["stands_mm"].get<double>() == Approx(15).margin(1));
    CHECK(report["best"][0]["largest_step_mm2"].get<double>() == Approx(40 * 30 - 36).epsilon(0.05));
    CHECK(report["best"][0]["load_across"].is_null());
    CHECK(contents(recipe) == table);

    REQUIRE(run_lamella("orient --plan 3 --write 1 " + recipe).code == 0);
    const std::string written = contents(recipe);
    CHECK(mentions(written, "# a table\n[part]  # of wood\nlay_on = ["));
    CHECK(!mentions(written, "turn ="));
    CHECK(mentions(written, "\nfield = \"table\"\n\n[[field]]\n"));
    const Json again = Json::parse(run_lamella("orient --json --plan 0 " + recipe).out);
    CHECK(again["now"]["estimated_supports_mm3"].get<double>() < 1);
    REQUIRE(run_lamella("orient --plan 0 --write 2 " + recipe).code == 0);
    CHECK(contents(recipe).find("lay_on") == contents(recipe).rfind("lay_on"));
}

TEST_CASE("orient tells of suction cups where a vat makes them", "[orientation]") {
    const Folder folder;
    // A pot: its hollow of 20 x 20 x 18 mm is a cup while it opens upward or to the bed.
    write(folder / "pot.toml",
          "[part]\nfield = \"pot\"\n[[field]]\nname = \"pot\"\nformula = \"max(max(abs(x) - 12, abs(y) - 12, "
          "abs(z - 10) - 10), -max(abs(x) - 10, abs(y) - 10, 2 - z))\"\nbounds = [[-12, -12, 0], [12, 12, "
          "20]]\n[layers]\nheight = 0.1\n");
    const std::string orient = "orient --json --plan 0 --for height --count 6 " + folder / "pot.toml";
    const Json report = Json::parse(run_lamella(orient + " --printer prusa-sl1s").out);
    CHECK(report["now"]["cups_mm3"].get<double>() == Approx(20 * 20 * 18).epsilon(0.05));
    int upright = 0, lying = 0;
    for (const Json& one : report["best"]) {
        const double cups = one["cups_mm3"].get<double>(), z = one["lay_on"][2].get<double>();
        if (std::abs(z) > 0.999) {
            CHECK(cups == Approx(20 * 20 * 18).epsilon(0.05));
            ++upright;
        } else if (std::abs(z) < 0.001) {
            CHECK(cups == 0);
            ++lying;
        }
    }
    CHECK(upright > 0);
    CHECK(lying > 0);
    CHECK(Json::parse(run_lamella(orient + " --printer marlin").out)["now"]["cups_mm3"].is_null());
    CHECK(
        mentions(run_lamella("orient --plan 0 --printer prusa-sl1s " + folder / "pot.toml").out, "   cups"));
}

TEST_CASE("orient says what it cannot write", "[orientation]") {
    const Folder folder;
    write(folder / "several.toml", "[part]\nshape = \"box\"\nsize = [4, 5, 6]\nturn = [\n  1, 2,\n  3]\n");
    const Outcome several = run_lamella("orient --write 1 " + folder / "several.toml");
    CHECK(several.code == 2);
    CHECK(mentions(several.err, "on several lines"));
    const Outcome many = run_lamella("orient --count 2 --write 3 " + folder / "several.toml");
    CHECK(many.code == 2);
    CHECK(mentions(many.err, "there is no orientation 3"));
    const Outcome shape = run_lamella("orient --shape box --shape-size 4,5,6 --write 1");
    CHECK(shape.code == 2);
    CHECK(mentions(shape.err, "--lay-on="));
    const Outcome goal = run_lamella("orient --shape box --shape-size 4,5,6 --for looks");
    CHECK(goal.code == 2);
    CHECK(mentions(goal.err, "supports,height,surface,area,strength"));
}

TEST_CASE("orient lays loads along the layers", "[orientation]") {
    const std::string box = "orient --shape box --shape-size 20,30,40 --json --for strength";
    const Json along = Json::parse(run_lamella(box + " --load 0,0,2").out);
    CHECK(along["now"]["load_across"].get<double>() == Approx(1));
    CHECK(along["best"][0]["load_across"].get<double>() < 0.01);
    CHECK(along["best"][0]["estimated_supports_mm3"].get<double>() < 1);
    CHECK(along["best"][0]["supports_mm3"].is_null());
    const Outcome none = run_lamella(box);
    CHECK(none.code == 2);
    CHECK(mentions(none.err, "--load X,Y,Z"));
    for (const char* const wrong : {"1,2", "0,0,0", "nan,0,1", "up"}) {
        const Outcome refused = run_lamella(box + " --load " + wrong);
        CHECK(refused.code == 2);
        CHECK(mentions(refused.err, "is no direction"));
    }
}

TEST_CASE("orient draws a sheet of the first ten", "[orientation]") {
    const Folder folder;
    const std::string sheet = folder / "sheet.png";
    const std::string box = "orient --shape box --shape-size 4,5,6 --for height --count 7 --picture ";
    REQUIRE(run_lamella(box + sheet).code == 0);
    const std::string png = contents(sheet);
    REQUIRE(png.size() > 24);
    const auto number = [&](std::size_t at) {
        return static_cast<unsigned char>(png[at + 2]) * 256 + static_cast<unsigned char>(png[at + 3]);
    };
    CHECK(number(16) == 5 * 320);
    CHECK(number(20) == 2 * 320);
    const Outcome refused = run_lamella(box + folder / "sheet.txt");
    CHECK(refused.code == 2);
    CHECK(mentions(refused.err, "--picture"));
}

}  // namespace command_orient_test
