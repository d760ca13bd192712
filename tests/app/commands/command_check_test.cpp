// Print checks as users of the command meet them: what is found, how it is told, and what else it changes.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/commands/boxes_mesh.h"
#include "tests/app/commands/command_run.h"

namespace command_check_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

/// A recipe's or a model's arguments, with boxes as the part and rows that boxes of whole eighths fill.
std::string boxes(const Folder& folder, const std::vector<Box>& parts, double layer_height = 0.25) {
    write(folder / "boxes.obj", boxes_obj(parts));
    return fmt::format("{} --layer-height {} --check-pitch 0.125 ", folder / "boxes.obj", layer_height);
}

/// Only these checks fail, with words of --check-NAME; all others are off.
std::string only(const std::vector<std::string>& checks) {
    std::string flags;
    for (const std::string name :
         {"connectivity", "sheets", "islands", "overhangs", "bridges", "thickness", "necks", "gaps",
          "cavities", "cups", "peel", "build-volume", "empty-layers"}) {
        const bool on = std::ranges::find(checks, name) != checks.end();
        flags += fmt::format("--check-{} {} ", name, on ? "fail" : "off");
    }
    return flags;
}

/// The one result of a check that was asked for alone.
Json result_of(const std::string& arguments, const std::string& check, int code) {
    const Outcome run = run_lamella("check -q --json " + arguments + only({check}));
    REQUIRE(run.code == code);
    const Json report = Json::parse(run.out);
    CHECK(report["passed"] == (code == 0));
    REQUIRE(report["checks"].size() == 1);
    return report["checks"][0];
}

const std::string block = "--shape box --shape-size 20,20,20 --layer-height 0.5 ";
/// 7 mm of void in a ball of 8 mm.
const std::string hollow = "--shape sphere --shape-radius 8 --skin 1 --layer-height 0.2 ";
constexpr double hollow_volume = 4.0 / 3 * 3.14159265358979 * 343;

std::vector<Box> two_blocks() { return {{{0, 0, 0}, {10, 10, 10}}, {{20, 0, 0}, {25, 5, 2}}}; }

}  // namespace

TEST_CASE("a block passes on every kind of machine, with a line for each check", "[check]") {
    for (const auto& [printer, process, checks] :
         std::vector<std::tuple<std::string, std::string, int>>{{"prusa-mk4", "filament", 9},
                                                                {"prusa-sl1s", "resin", 11},
                                                                {"powder-bed", "powder", 6},
                                                                {"binder-jet-600", "powder", 7},
                                                                {"grbl-laser", "cutting", 8},
                                                                {"svg", "cutting", 7}}) {
        const Outcome run = run_lamella("check -q " + block + "--printer " + printer);
        CHECK(run.code == 0);
        CHECK(run.err.empty());
        CHECK(run.out.starts_with(
            fmt::format("box on {} ({}): all {} checks pass\n", printer, process, checks)));
        CHECK(std::count(run.out.begin(), run.out.end(), '\n') == checks + 3);
    }
}

TEST_CASE("a second piece is told with its volume and place, and decides the exit code", "[check]") {
    const Folder folder;
    const std::string part = boxes(folder, two_blocks());
    const Json found = result_of(part, "connectivity", 1);
    CHECK(found["verdict"] == "fail");
    CHECK(found["count"] == 1);
    CHECK(found["total_mm3"].get<double>() == Approx(50));
    const Json& fault = found["worst"][0];
    CHECK(fault["size_mm3"].get<double>() == Approx(50));
    CHECK(fault["first_layer"] == 0);
    CHECK(fault["end_layer"] == 8);
    for (int k = 0; k < 3; ++k) {
        CHECK(fault["box_mm"]["lo"][k].get<double>() == Approx(k == 0 ? 20 : 0).margin(0.01));
        CHECK(fault["box_mm"]["hi"][k].get<double>() == Approx(k == 2 ? 2 : 25 - 20 * (k > 0)).margin(0.01));
    }
    // Every run lies in the piece, and together they are its section.
    double area = 0;
    for (const Json& run : fault["runs_x_y_x_y_mm"]) {
        CHECK(run[1] == run[3]);
        CHECK(run[1].get<double>() > 0);
        CHECK(run[1].get<double>() < 5);
        area += (run[2].get<double>() - run[0].get<double>()) * 0.125;
    }
    CHECK(area == Approx(25));
    const std::string asked = "check -q " + part + only({"connectivity"});
    const Outcome failed = run_lamella(asked);
    CHECK(failed.code == 1);
    CHECK(mentions(failed.out, "boxes on generic-8k (resin): 1 of 1 checks fail\n"));
    CHECK(
        mentions(failed.out, "connectivity  one piece, but for crumbs below 0.0000156 mm3  FAIL  1 place\n"));
    CHECK(mentions(failed.out, "  50.0 mm3    at ("));
    CHECK(mentions(failed.out, ", layers 0 to 7\n"));
    CHECK(failed.err == "lamella: boxes cannot be printed as it is on generic-8k: connectivity (1 place)\n");
    const Outcome warned = run_lamella(asked + "--check-connectivity warn");
    CHECK(warned.code == 0);
    CHECK(warned.err.empty());
    CHECK(mentions(warned.out, "nothing fails, 1 of 1 checks warn\n"));
    CHECK(mentions(warned.out, "\nwarn connectivity: "));
    CHECK(run_lamella(asked + "--check-connectivity off").code == 0);
}

TEST_CASE("closed voids, gaps between layers and parts too large are as large as they are", "[check]") {
    const Folder folder;
    const Json cavity = result_of(hollow + "--check-pitch 0.1 ", "cavities", 1);
    CHECK(cavity["count"] == 1);
    CHECK(cavity["limit_mm3"] == 1);
    CHECK(cavity["total_mm3"].get<double>() == Approx(hollow_volume).epsilon(0.01));
    CHECK(result_of(hollow + "--check-least-cavity 1500 ", "cavities", 0)["count"] == 0);
    CHECK(result_of(hollow + "--drains 1 ", "cavities", 0)["count"] == 0);

    const std::string stacked = boxes(folder, {{{0, 0, 0}, {5, 5, 5}}, {{0, 0, 7}, {5, 5, 9}}});
    const Json gap = result_of(stacked, "empty-layers", 1);
    CHECK(gap["worst"][0]["size_mm"].get<double>() == Approx(2));
    CHECK(gap["worst"][0]["first_layer"] == 20);
    CHECK(gap["worst"][0]["end_layer"] == 28);

    const std::string bar = "--shape box --shape-size 300,20,20 --layer-height 1 ";
    const Json reach = result_of(bar + "--printer prusa-mk4 ", "build-volume", 1);
    CHECK(reach["limit"] == "within 238 x 198 x 220 mm");
    CHECK(reach["worst"][0]["size_mm"].get<double>() == Approx(62).margin(0.1));
    // Another brim, another room: the back-end asks for what it lays beside the part.
    CHECK(result_of(bar + "--printer prusa-mk4 --printer-brim 4 ", "build-volume", 1)["worst"][0]["size_mm"]
              .get<double>() > 69);
}

TEST_CASE("what is held is no overhang, and limits are the machine's", "[check]") {
    const Folder folder;
    const std::string top = boxes(folder, table(), 0.2) + "--printer marlin ";
    const Json bare = result_of(top, "overhangs", 1);
    CHECK(bare["limit_mm"] == 0.225);
    // What stands out: the top less the column, less what a layer may stand out by.
    CHECK(bare["total_mm2"].get<double>() == Approx(400 - 25).epsilon(0.1));
    CHECK(result_of(top + "--support none --support-overhang 11 ", "overhangs", 0)["limit_mm"] == 11);
    CHECK(result_of(top + "--support bridges ", "overhangs", 0)["count"] == 0);
    CHECK(result_of(block + "--printer creality-ender-3 ", "thickness", 0)["limit_mm"] == 0.4);
    CHECK(result_of(block + "--printer marlin --printer-nozzle 0.8 ", "thickness", 0)["limit_mm"] == 0.8);
    CHECK(result_of("--shape box --shape-size 20,0.6,20 --layer-height 0.5 --printer marlin "
                    "--printer-nozzle 0.8 ",
                    "thickness", 1)["count"] == 1);
}

TEST_CASE("JSON tells all limits, unknown ones as null", "[check]") {
    const Json bed = Json::parse(run_lamella("check -q --json " + block +
                                             "--printer prusa-mk4 --check-least-cup 7 --layer-height 0.25")
                                     .out);
    CHECK(bed["process"] == "filament");
    CHECK(bed["layers"] == 80);
    CHECK(bed["volume_mm3"].get<double>() == Approx(8000).epsilon(0.01));
    CHECK(bed["limits_mm"]["build_volume"] == Json({238, 198, 220}));
    CHECK(bed["limits_mm"]["neck"] == 0.9);
    CHECK(bed["limits_mm"]["overhang"] == 0.225);
    CHECK(bed["limits_mm3"]["cup"] == 7);
    const Json open = Json::parse(run_lamella("check -q --json " + block + "--printer prusa-sl1s").out);
    CHECK(open["limits_mm"]["build_volume"] == Json({128, 81, nullptr}));
}

TEST_CASE("wrong limits are told by their names, and nothing is written", "[check]") {
    const Folder folder;
    for (const auto& [wrong, message] : std::vector<std::pair<std::string, std::string>>{
             {"--check-gaps maybe", "--check-gaps: \"maybe\" is unknown"},
             {"--check-process resins", "--check-process: \"resins\" is unknown, did you mean `resin`?"},
             {"--check-least-thickness thin", "--check-least-thickness: "},
             {"--check-places 0", "--check-places: 0 is too small"},
             {"--check-pitch 5 --check-thickness fail", "makes no sense"},
             {"--layers 1:3", "--layers"}}) {
        const Outcome run = run_lamella(fmt::format("check {}{} -o {} --report {}", block, wrong,
                                                    folder / "table", folder / "page.html"));
        INFO(wrong);
        CHECK(run.code == 2);
        CHECK(mentions(run.err, message));
    }
    write(folder / "wrong.toml", "[part]\nshape = \"sphere\"\nradius = 5\n[check]\nthicknes = \"fail\"\n");
    const Outcome recipe = run_lamella("check " + folder / "wrong.toml");
    CHECK(recipe.code == 2);
    CHECK(mentions(recipe.err, "wrong.toml:5: check.thicknes: unknown key, did you mean `thickness`?"));
    CHECK(tree(folder.path()).size() == 1);
}

TEST_CASE("a file that cannot be made is told of before anything is looked at", "[check]") {
    const Folder folder;
    const std::string good = folder / "good", bad = folder / "missing" + "/bad";
    for (const auto& [table, page] : {std::pair(good, bad), std::pair(bad, good)}) {
        const Outcome run = run_lamella(fmt::format("check {} -o {} --report {}", block, table, page));
        CHECK(run.code == 3);
        CHECK(mentions(run.err, bad + ".part: cannot be made: No such file or directory"));
        CHECK(!mentions(run.err, "layers"));
        CHECK(tree(folder.path()).empty());
    }
    const Outcome twice = run_lamella(fmt::format("check {} -o {} --report {}", block, good, good));
    CHECK(twice.code == 2);
    CHECK(mentions(twice.err, "is also the file of --output"));
    CHECK(tree(folder.path()).empty());
}

TEST_CASE("a loose piece smaller than a pixel is no fault unless asked for", "[check]") {
    const Folder folder;
    write(folder / "crumb.obj",
          boxes_obj({{dvec3(0), dvec3(2, 2, 0.5)}, {dvec3(3, 3, 0), dvec3(3.04, 3.04, 0.045)}}));
    const std::string check =
        fmt::format("check -q {} --printer-pixel 0.05 --layer-height 0.02 --check-pitch 0.01 {}",
                    folder / "crumb.obj", only({"connectivity"}));
    CHECK(run_lamella(check).code == 0);
    CHECK(run_lamella(check + " --check-least-piece 0.00001").code == 1);
    const Outcome all = run_lamella(check + " --check-least-piece 0");
    CHECK(all.code == 1);
    CHECK(mentions(all.out, "the part is one piece"));
}

TEST_CASE("a tip below a roof is an island if it is large or high", "[check]") {
    const Folder folder;
    const auto check = [&](double width, double height, const std::string& more) {
        write(folder / "roof.obj", boxes_obj({{dvec3(0), dvec3(1, 4, 3)},
                                              {dvec3(0, 0, 3), dvec3(4, 4, 4)},
                                              {dvec3(2, 2, 3 - height), dvec3(2 + width, 2 + width, 3)}}));
        return run_lamella(fmt::format("check -q {} --layer-height 0.05 --check-pitch 0.02 {} {}",
                                       folder / "roof.obj", only({"islands"}), more));
    };
    CHECK(check(0.15, 0.1, "").code == 0);
    CHECK(mentions(check(0.15, 0.1, "").out, "nothing in the air but specks below 0.04 mm2"));
    CHECK(check(0.25, 0.1, "").code == 1);
    CHECK(check(0.25, 0.1, "--check-least-island 0.1").code == 0);
    CHECK(mentions(check(0.15, 0.5, "").out, " mm, layer 54\n"));  // four layers above its tip
    const Outcome all = check(0.15, 0.1, "--check-least-island 0");
    CHECK(all.code == 1);
    CHECK(mentions(all.out, "nothing begins in the air"));
}

TEST_CASE("slice --check writes the bytes of a run without it, and tells what it found", "[check]") {
    const Folder folder;
    const std::string part = boxes(folder, two_blocks());
    for (const std::string printer : {"svg", "marlin", "png --printer-width 600 --printer-height 600"}) {
        const std::string job = fmt::format("slice {}--printer {} -o ", part, printer);
        const std::string at = folder / printer.substr(0, 3);
        REQUIRE(run_lamella(job + at + "_plain").code == 0);
        const Outcome checked = run_lamella(job + at + "_checked --check --json " + only({"connectivity"}));
        CHECK(checked.code == 1);
        CHECK(mentions(checked.err, "connectivity  "));
        CHECK(mentions(checked.err, "one piece"));
        CHECK(mentions(checked.err, "  FAIL  1 place\n"));
        CHECK(mentions(checked.err, "all layers have been written nevertheless"));
        const Json summary = Json::parse(checked.out);
        REQUIRE(summary["checks"].size() == 1);
        CHECK(summary["checks"][0]["passed"] == false);
        CHECK(summary["checks"][0]["checks"][0]["total_mm3"].get<double>() == Approx(50));
        CHECK(summary["layers"] == 40);
        if (fs::is_directory(at + "_plain")) {
            CHECK(tree(at + "_checked") == tree(at + "_plain"));
        } else {
            CHECK(contents(at + "_checked") == contents(at + "_plain"));
        }
    }
    const Outcome quiet = run_lamella(
        fmt::format("slice {}--printer svg -q --check {}-o {}", part, only({"sheets"}), folder / "q.svg"));
    CHECK(quiet.code == 1);
    CHECK_FALSE(mentions(quiet.err, "each layer is one piece"));
    CHECK(mentions(quiet.err, "sheets (8 places)"));
}

TEST_CASE("slice --check says of masks what check says, from lines that both look at", "[check]") {
    const Folder folder;
    const std::string foam =
        "--shape box --shape-size 9,7,5 --cell 2 --beam 0.3 --layer-height 0.1 --support pillars "
        "--printer-pixel 0.025 ";
    const std::string landscape = "--printer-width 800 --printer-height 700 ";
    const auto report_of = [&](const std::string& more) {
        return Json::parse(run_lamella("check --json " + foam + more).out);
    };
    for (const auto& [machine, pitch] : std::vector<std::pair<std::string, double>>{
             {landscape + "--printer png ", 0.075},  // 12 quarters of a pixel
             {"--printer-width 700 --printer-height 800 --printer png --printer-portrait ", 0.075},
             {landscape + "--printer sl1 --printer-mirror-x ", 0.075},
             {landscape + "--printer nanodlp --printer-mirror-y --printer-sub-rows 3 ", 0.025 / 3 * 9},
             {landscape + "--printer png --printer-antialiasing off ", 0.075},
             {landscape + "--printer png --printer-antialiasing exact ", 0.08},
             {landscape + "--printer png --printer-sub-layers 2 ", 0.08},
             {landscape + "--printer png --check-pitch 0.1 ", 0.1}}) {
        INFO(machine);
        const Json alone = report_of(machine);
        CHECK(alone["pitch_mm"].get<double>() == Approx(pitch));
        const Outcome run =
            run_lamella("slice --check --json --force " + foam + machine + "-o " + folder / "out");
        REQUIRE((run.code == 0 || run.code == 1));
        CHECK(Json::parse(run.out)["checks"][0] == alone);
        CHECK(alone["checks"].size() == 11);
        fs::remove_all(folder / "out");
    }
}

TEST_CASE("slice --check looks at each output's machine, and at all layers or none", "[check]") {
    const Folder folder;
    const std::string bar = "slice --shape box --shape-size 230,20,4 --layer-height 0.4 --check -q --json ";
    const Outcome run = run_lamella(
        fmt::format("{} -o {}@prusa-mk4 -o {}@powder-bed", bar, folder / "bar.gcode", folder / "bar.cli"));
    REQUIRE(run.code == 0);
    const Json checks = Json::parse(run.out)["checks"];
    REQUIRE(checks.size() == 2);
    CHECK(checks[0]["process"] == "filament");
    CHECK(checks[1]["process"] == "powder");
    const Outcome range = run_lamella(bar + "--layers 0:5 --printer svg -o " + folder / "some.svg");
    CHECK(range.code == 2);
    CHECK(mentions(range.err, "--check: needs all layers"));
    CHECK_FALSE(fs::exists(folder / "some.svg"));
}

TEST_CASE("a run that is continued is checked as a whole", "[check]") {
    const Folder folder;
    const std::string job =
        "slice --shape sphere --shape-radius 8 --layer-height 0.02 --threads 2 --printer png "
        "--printer-width 1600 --printer-height 1600 --printer-pixel 0.0125 --check "
        "--check-overhangs off --check-pitch 0.1 -o ";
    const Outcome cut = interrupt_lamella(job + folder / "cut", [&] {
        std::uintmax_t sum = 0;
        std::error_code ignored;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path(), ignored))
            sum += entry.is_regular_file(ignored) ? entry.file_size(ignored) : 0;
        return sum > 100000;
    });
    REQUIRE(cut.code == 130);
    const Outcome resumed = run_lamella(job + folder / "cut --resume --json");
    REQUIRE(resumed.code == 0);
    const double ball = 4.0 / 3 * 3.14159265358979 * 512;
    CHECK(Json::parse(resumed.out)["checks"][0]["volume_mm3"].get<double>() == Approx(ball).epsilon(0.005));
    REQUIRE(run_lamella(job + folder / "whole -q").code == 0);
    CHECK(tree(folder / "cut") == tree(folder / "whole"));
}

TEST_CASE("several parts on a plate are no loose pieces", "[check]") {
    const Folder folder;
    const std::string copies = block + "--copies 2 --printer prusa-sl1s ";
    CHECK(run_lamella("check -q " + copies).code == 0);
    const Outcome plate = run_lamella("slice " + copies + "--check -o " + folder / "two.sl1s");
    CHECK(plate.code == 0);
    CHECK(mentions(plate.err, "note: Several parts stand on the plate"));
    CHECK(mentions(plate.err, "not looked at: connectivity, sheets, bridges\n"));
}

TEST_CASE("help says what is checked, by which keys, and with which exit code", "[check]") {
    const std::string help = run_lamella("check --help").out;
    for (const std::string text : {"--json", "--report FILE", "--check-least-thickness", "--check-cups",
                                   "Exit code 1", "lamella check model.stl"})
        CHECK(mentions(help, text));
    CHECK(mentions(run_lamella("slice --help").out, "--check "));
    CHECK(mentions(run_lamella("--help").out, "  check "));
    CHECK(mentions(run_lamella("keys").out, "[check]"));
}

}  // namespace command_check_test
