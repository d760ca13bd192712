// `lamella pattern` as users run it: sheets as pictures and contours, reports, mistakes.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "procedural/appearance/grey_image.h"
#include "tests/app/commands/command_run.h"

namespace command_pattern_test {

using namespace lamella;

namespace {

const std::string inputs = std::string(LAMELLA_SOURCE_DIR) + "/examples/inputs/";

}  // namespace

TEST_CASE("a sheet is written as a picture that can be an example again", "[pattern]") {
    const Folder folder;
    const std::string sheet = folder / "sheet.png", again = folder / "again.png";
    const Outcome made =
        run_lamella("pattern " + inputs + "net.png --invert --size 30 --sheet 32,30 --json -o " + sheet);
    REQUIRE(made.code == 0);
    const auto report = nlohmann::json::parse(made.out);
    CHECK(report["sheet_mm"][0] == Approx(32));
    CHECK(report["sheet_mm"][1].get<double>() == Approx(30).margin(0.4 + 1e-9));
    const double share = report["solid_share"];
    CHECK(share == Approx(report["example_share"].get<double>()).epsilon(0.05));
    // Light is solid here, too.
    const GreyImage picture = solidity(read_picture(sheet), true);
    double sum = 0;
    for (const double value : picture.values) sum += value;
    CHECK(sum / static_cast<double>(picture.values.size()) == Approx(share).margin(0.005));
    CHECK(run_lamella("pattern " + sheet + " --invert --size 32 --sheet 32,30 -o " + again).code == 0);
    // The same bytes on another number of threads.
    const std::string on_one = folder / "one.png";
    run_lamella("pattern " + inputs + "net.png --invert --size 30 --sheet 32,30 --threads 1 -o " + on_one);
    CHECK(contents(on_one) == contents(sheet));
}

TEST_CASE("a sheet is written as contours, and reported without a file", "[pattern]") {
    const Folder folder;
    const std::string sheet = folder / "sheet.svg";
    REQUIRE(run_lamella("pattern " + inputs + "blobs.png --size 24 --sheet 30,30 -o " + sheet).code == 0);
    CHECK(mentions(contents(sheet), "width=\"30mm\""));
    CHECK(mentions(contents(sheet), "fill-rule=\"evenodd\""));
    const Outcome told = run_lamella("pattern " + inputs + "bricks.png --size 24 --sheet 24,24 --gap 0.5");
    CHECK(told.code == 0);
    CHECK(mentions(told.out, "bridges"));
    CHECK(mentions(told.out, "a larger --size keeps them"));
}

TEST_CASE("what cannot be a sheet ends with one message", "[pattern]") {
    const Folder folder;
    const auto told = [](const std::string& arguments) {
        const Outcome outcome = run_lamella("pattern " + arguments);
        CHECK(outcome.code == 2);
        return outcome.err;
    };
    CHECK(mentions(told(inputs + "net.png -o " + folder / "sheet.stl"), "neither .png nor .svg"));
    CHECK(mentions(told(folder / "missing.png"), "missing.png"));
    CHECK(mentions(told(inputs + "net.png --size 3"), "accepted: a picture of more pixels"));
    CHECK(mentions(told(inputs + "net.png --sheet 5"), "--sheet"));
    CHECK(mentions(told(inputs + "net.png --strut -1"), "--strut"));
    CHECK(mentions(told(inputs + "net.png --threshold 0"), "the picture is all void"));
    CHECK(mentions(told(inputs + "net.png --pixel 0.001 -o " + folder / "large.png"),
                   "makes a picture of 40000 x 40000 pixels"));
    CHECK(!std::filesystem::exists(folder / "sheet.stl"));
    CHECK(!std::filesystem::exists(folder / "large.png"));
}

}  // namespace command_pattern_test
