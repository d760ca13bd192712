// `lamella optimize` and `lamella analyze`: reports, files, kept results, mistakes, and Ctrl-C.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "procedural/volume/volume.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"

namespace command_optimize_test {

using namespace lamella;
using Json = nlohmann::json;

namespace {

const std::string plate =
    "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n[material]\nyoung = 2000\npoisson = 0.3\ndensity = 1.2\n"
    "[[load]]\nbox = [[19.9, -0.1, -3], [20.1, 0.1, 3]]\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n";
const std::string search = "[optimize]\ndimensions = 2\nelements = 40\niterations = 30\nvolume = 0.4\n";

}  // namespace

TEST_CASE("optimize reports the search, and saves the densities", "[optimization]") {
    const Folder folder;
    write(folder / "plate.toml", plate + search);
    const Outcome text = run_lamella("optimize " + folder / "plate.toml");
    CHECK(text.code == 0);
    for (const char* words : {"800 in a grid of 40 x 20", "E = 2000 MPa", "of at most 40.00 %", "von Mises"})
        CHECK(mentions(text.out, words));
    CHECK(mentions(text.err, "30/30"));
    const Outcome json = run_lamella("optimize -q --json " + folder / "plate.toml" + " --save " +
                                     folder / "plate.nrrd" + " --plot " + folder / "plate.svg");
    const std::string plot = contents(folder / "plate.svg");
    for (const char* words :
         {"30 steps", "compliance, N mm", "% of the part", "<rect", "<polygon", "<circle"})
        CHECK(mentions(plot, words));
    CHECK(plot.ends_with("</svg>\n"));
    CHECK(json.code == 0);
    CHECK(json.err.empty());
    const Json report = Json::parse(json.out);
    CHECK(report["history"].size() == 30);
    CHECK(report["volume"].get<double>() == Approx(0.4).epsilon(0.005));
    CHECK(report["cases"][0]["largest_displacement_mm"].get<double>() > 0);
    const Volume saved = read_volume(folder / "plate.nrrd");
    CHECK(saved.size == std::array<std::size_t, 3>{120, 60, 1});  // three samples along an element
    REQUIRE(saved.box);
    CHECK(saved.box->lo.x == Approx(-20));
    CHECK(saved.box->hi.y == Approx(10));
}

TEST_CASE("a part that is optimised under the overhang limit is printed without supports",
          "[optimization][slow]") {
    const Folder folder;
    write(folder / "bracket.toml",
          "[part]\nshape = \"box\"\nsize = [60, 30, 30]\n[material]\nname = \"pla\"\n"
          "[[load]]\nbox = [[30, -15, -15], [30, 15, -15]]\nforce = [0, 0, -100]\n[[anchor]]\nface = \"-x\"\n"
          "[optimize]\nelements = 32\nvolume = 0.2\nsymmetry = \"y\"\niterations = 50\n[layers]\nheight = "
          "0.2\n");
    const auto overhangs = [&](const std::string& flag) {
        const Outcome check = run_lamella("check -q --json " + folder / "bracket.toml" + " --plans " +
                                          folder / "plans" + " --printer marlin " + flag);
        const Json report = Json::parse(check.out);
        for (const Json& result : report["checks"]) {
            if (result["check"] == "overhangs") return result["count"].get<int>();
        }
        return -1;
    };
    CHECK(overhangs("--optimize-overhang") == 0);
    CHECK(overhangs("") > 0);
}

TEST_CASE("no member and no gap is thinner than asked", "[optimization][slow]") {
    struct Problem {
        std::string size, loads;
        int elements;
        double least;
    };
    const std::string half_beam =
        "[[load]]\nbox = [[-60, 20, -2], [-60, 20, 2]]\nforce = [0, -10, 0]\n"
        "[[anchor]]\nface = \"-x\"\nfix = \"x\"\n[[anchor]]\nbox = [[58, -20, -2], [60, -20, 2]]\nfix = "
        "\"y\"\n";
    const std::string console =
        "[[load]]\nbox = [[40, -1, -2], [40, 1, 2]]\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n";
    const std::string two_cases =
        "[[load]]\nbox = [[30, 26, -2], [30, 30, 2]]\nforce = [0, 10, 0]\ncase = \"up\"\n"
        "[[load]]\nbox = [[30, -30, -2], [30, -26, 2]]\nforce = [0, -10, 0]\ncase = \"down\"\n"
        "[[anchor]]\nface = \"-x\"\n";
    for (const Problem& problem :
         {Problem{"120, 40, 3", half_beam, 150, 4}, Problem{"80, 40, 3", console, 120, 3},
          Problem{"60, 60, 3", two_cases, 100, 3}}) {
        const Folder folder;
        const std::string least = std::to_string(problem.least);
        write(folder / "plate.toml",
              "[part]\nshape = \"box\"\nsize = [" + problem.size + "]\n" + problem.loads +
                  "[optimize]\ndimensions = 2\nvolume = 0.4\nelements = " + std::to_string(problem.elements) +
                  "\nmember = " + least + "\ngap = " + least + "\n");
        const Outcome check = run_lamella(
            "check -q " + folder / "plate.toml" + " --plans " + folder / "plans" +
            " --printer laser-500x300 --check-least-thickness " + least + " --check-least-gap " + least);
        CAPTURE(problem.loads, check.out);
        CHECK(check.code == 0);
    }
}

TEST_CASE("slice prints what optimize has found, without another search", "[optimization]") {
    const Folder folder;
    write(folder / "plate.toml", plate + search);
    const std::string plans = " --plans " + folder / "plans";
    REQUIRE(run_lamella("optimize " + folder / "plate.toml" + plans).code == 0);
    const Outcome slice = run_lamella("slice " + folder / "plate.toml" + plans + " --layer-height 2 -o " +
                                      folder / "plate.svg");
    CHECK(slice.code == 0);
    CHECK_FALSE(mentions(slice.err, "optimising"));
    // 40 % of 40 x 20 x 4 mm.
    CHECK(mentions(slice.err, "mm3 of material"));
    const Outcome anew = run_lamella("slice " + folder / "plate.toml" + " --plans '' --layer-height 2 -o " +
                                     folder / "again.svg");
    CHECK(anew.code == 0);
    CHECK(mentions(anew.err, "optimising"));
    CHECK(contents(folder / "plate.svg") == contents(folder / "again.svg"));
}

TEST_CASE("analyze says how a part bends, and what it needs for that", "[optimization]") {
    const Folder folder;
    write(folder / "plate.toml", plate);
    const Outcome full = run_lamella("analyze --json " + folder / "plate.toml");
    REQUIRE(full.code == 0);
    const Json report = Json::parse(full.out);
    CHECK(report["compliance_nmm"].get<double>() == Approx(report["full_compliance_nmm"].get<double>()));
    CHECK(report["history"].empty());
    const Outcome law = run_lamella("analyze --model law " + folder / "plate.toml");
    CHECK(law.code == 2);
    CHECK(mentions(law.err, "no foam whose law is known"));
    write(folder / "free.toml", "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n");
    const Outcome free = run_lamella("analyze " + folder / "free.toml");
    CHECK(free.code == 2);
    CHECK(mentions(free.err, "a [[load]] and an [[anchor]]"));
    const Outcome nothing = run_lamella("optimize " + folder / "plate.toml");
    CHECK(nothing.code == 2);
    CHECK(mentions(nothing.err, "[optimize] is missing"));
}

TEST_CASE("Ctrl-C ends a search with a report of the best design so far", "[optimization]") {
    const Folder folder;
    write(folder / "plate.toml",
          plate + "[optimize]\ndimensions = 2\nelements = 200\niterations = 10000\ntolerance = 1e-9\n");
    const pid_t child = start_lamella("optimize --json " + folder / "plate.toml", folder);
    for (int i = 0; i < 600 && !mentions(contents(folder / "err"), "10/10000"); ++i) usleep(100'000);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WEXITSTATUS(status) == 130);
    const Json report = Json::parse(contents(folder / "out"));
    CHECK(report["history"].size() >= 10);
    CHECK_FALSE(report["converged"].get<bool>());
    CHECK(report["compliance_nmm"].get<double>() > 0);
}

TEST_CASE("a search that was stopped goes on to the same result", "[optimization]") {
    const Folder folder;
    const std::string mma =
        plate +
        "[optimize]\ndimensions = 2\nelements = 160\niterations = 150\ntolerance = 0\nmethod = \"mma\"\n";
    write(folder / "plate.toml", mma);
    const std::string command = "optimize --json " + folder / "plate.toml" + " --plans " + folder / "plans";
    const Outcome nothing = run_lamella(command + " --resume");
    CHECK(nothing.code == 2);
    CHECK(mentions(nothing.err, "keeps no search of this recipe that was stopped"));
    const pid_t child = start_lamella(command, folder);
    for (int i = 0; i < 6000 && !mentions(contents(folder / "err"), "30/150"); ++i) usleep(20'000);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WEXITSTATUS(status) == 130);
    const Json stopped = Json::parse(contents(folder / "out"));
    REQUIRE(stopped["history"].size() >= 30);
    REQUIRE(stopped["history"].size() < 150);
    const Outcome resumed = run_lamella(command + " --resume");
    REQUIRE(resumed.code == 0);
    const Outcome whole = run_lamella("optimize --json " + folder / "plate.toml" + " --plans ''");
    CHECK(Json::parse(resumed.out) == Json::parse(whole.out));
    CHECK(run_lamella(command + " --resume").code == 2);
}

}  // namespace command_optimize_test
