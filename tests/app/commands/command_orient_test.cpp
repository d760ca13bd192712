// `lamella orient`: its list, and what it writes into recipes.
#include <catch2/catch.hpp>
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
    const Outcome listed = run_lamella("orient --json --count 4 " + recipe);
    REQUIRE(listed.code == 0);
    const Json report = Json::parse(listed.out);
    REQUIRE(report["best"].size() == 4);
    CHECK(report["best"][0]["supports_mm3"].get<double>() < 1);
    CHECK(report["best"][0]["lay_on"][2].get<double>() == Approx(1).margin(1e-5));
    CHECK(report["best"][3]["supports_mm3"].is_null());
    CHECK(report["now"]["estimated_supports_mm3"].get<double>() > 100);
    CHECK(contents(recipe) == table);

    REQUIRE(run_lamella("orient --write 1 " + recipe).code == 0);
    const std::string written = contents(recipe);
    CHECK(mentions(written, "# a table\n[part]  # of wood\nlay_on = ["));
    CHECK(!mentions(written, "turn ="));
    CHECK(mentions(written, "\nfield = \"table\"\n\n[[field]]\n"));
    const Json again = Json::parse(run_lamella("orient --json " + recipe).out);
    CHECK(again["now"]["estimated_supports_mm3"].get<double>() < 1);
    REQUIRE(run_lamella("orient --write 2 " + recipe).code == 0);
    CHECK(contents(recipe).find("lay_on") == contents(recipe).rfind("lay_on"));
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
    const Outcome goal = run_lamella("orient --shape box --shape-size 4,5,6 --for strength");
    CHECK(goal.code == 2);
    CHECK(mentions(goal.err, "supports,height,surface,area"));
}

}  // namespace command_orient_test
