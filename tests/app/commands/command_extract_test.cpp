// Finished jobs as users look into them, and outputs that go down a pipe.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/commands/command_run.h"

namespace command_extract_test {

using namespace lamella;

namespace {

const std::string ball = "--shape sphere --shape-radius 3 --layer-height 0.2 -q ";
const std::string plate = "--printer-width 200 --printer-height 180 --printer-pixel 0.05 ";
const double ball_volume = 4.0 / 3.0 * 3.14159265358979 * 27;

/// A line of the shell that begins with `lamella`; returns its exit code.
int shell(const std::string& arguments) {
    const std::string line = LAMELLA_COMMAND + (" " + arguments);
    const int status = std::system(("bash -c '" + line + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("info tells what a finished job holds, whatever its kind and name") {
    const Folder folder;
    for (const std::string kind : {"sl1", "goo", "nanodlp", "png"}) {
        const std::string path = folder / kind;  // no ending tells the kind
        REQUIRE(run_lamella("slice " + ball + plate + "--printer-kind " + kind + " -o " + path).code == 0);
        const Outcome info = run_lamella("info --json " + path);
        REQUIRE(info.code == 0);
        const auto json = nlohmann::json::parse(info.out);
        CHECK(json["layers"] == 30);
        CHECK(json["layer_height_mm"].get<double>() == Approx(0.2));
        CHECK(json["width_px"] == 200);
        CHECK(json["height_px"] == 180);
        CHECK(json["mask_volume_mm3"].get<double>() == Approx(ball_volume).epsilon(2e-3));
        CHECK(json["area_mm2"]["mean"].get<double>() == Approx(ball_volume / 6).epsilon(2e-3));
        CHECK(json["area_mm2"]["highest"].get<double>() == Approx(3.14159 * 9).epsilon(3e-3));
        CHECK(std::abs(json["area_mm2"]["highest_layer"].get<int>() - 14.5) < 1);
        CHECK(json["empty_layers"] == 0);
        const Outcome text = run_lamella("info " + path);
        CHECK(text.code == 0);
        CHECK(mentions(text.out, "30 of 0.2 mm"));
        CHECK(mentions(text.out, "200 x 180 px"));
    }
}

TEST_CASE("extract gives the stack that a job was made of, and the stack is a job again") {
    const Folder folder;
    REQUIRE(run_lamella("slice " + ball + plate + "--printer-kind png -o " + folder / "stack").code == 0);
    const auto expected = tree(folder / "stack");
    for (const std::string kind : {"sl1", "goo", "nanodlp"}) {
        const std::string path = folder / ("ball." + kind), out = folder / (kind + "-masks");
        REQUIRE(run_lamella("slice " + ball + plate + "--printer-kind " + kind + " -o " + path).code == 0);
        REQUIRE(run_lamella("extract -q " + path + " -o " + out).code == 0);
        auto found = tree(out);
        CHECK(found.size() == 31);
        const auto job = nlohmann::json::parse(found.at("job.json"));
        CHECK(job["layer_count"] == 30);
        CHECK(job["extracted_from"] == "ball." + kind);
        for (const auto& [name, content] : expected) {
            if (name != "job.json") CHECK(found.at(name) == content);
        }
        const auto again = nlohmann::json::parse(run_lamella("info --json " + out).out);
        CHECK(again["mask_volume_mm3"].get<double>() == Approx(ball_volume).epsilon(2e-3));
        CHECK(run_lamella("extract -q " + path + " -o " + out).code == 2);
        CHECK(run_lamella("extract -q --force --layers 3:5 " + path + " -o " + out).code == 0);
        found = tree(out);
        CHECK(found.size() == 3);
        CHECK(found.at("00004.png") == expected.at("00004.png"));
    }
}

TEST_CASE("what is no job, or a damaged one, ends with code 2 and its name") {
    const Folder folder;
    REQUIRE(run_lamella("slice " + ball + plate + "--printer-kind goo -o " + folder / "a.goo").code == 0);
    write(folder / "cut.goo", contents(folder / "a.goo").substr(0, 196000));
    write(folder / "text.sl1", "nothing");
    for (const std::string name : {"cut.goo", "text.sl1", "absent.sl1"}) {
        for (const std::string& command : {std::string("info "), "extract -o " + (folder / "out") + " "}) {
            const Outcome outcome = run_lamella(command + (folder / name));
            CHECK(outcome.code == 2);
            CHECK(outcome.out.empty());
            CHECK(mentions(outcome.err, folder / name));
            CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        }
    }
    CHECK(run_lamella("extract --layers 20:40 " + (folder / "a.goo") + " -o " + (folder / "out")).code == 2);
    CHECK(run_lamella("extract").code == 2);
}

TEST_CASE("standard output takes the bytes of the file, and nothing else") {
    const Folder folder;
    for (const std::string kind : {"sl1", "nanodlp", "svg", "gcode"}) {
        INFO(kind);
        const std::string flags = "slice " + ball + plate + "--printer-kind " + kind + " -o ";
        REQUIRE(run_lamella(flags + (folder / kind)).code == 0);
        const Outcome piped = run_lamella(flags + "-");
        CHECK(piped.code == 0);
        CHECK(piped.err.empty());
        CHECK((piped.out == contents(folder / kind)));
    }
    const std::string ember = "slice " + ball + "--printer ember -o ";
    REQUIRE(run_lamella(ember + (folder / "e.tar.gz")).code == 0);
    CHECK((run_lamella(ember + "-").out == contents(folder / "e.tar.gz")));
    CHECK(shell(ember + "- | tar tz | tail -1 | grep -q slice_30.png") == 0);
    REQUIRE(run_lamella("slice " + ball + plate + "--printer-kind png -o " + (folder / "stack")).code == 0);
    std::string all;
    for (const auto& [name, content] : tree(folder / "stack")) {
        if (name != "job.json") all += content;
    }
    CHECK((run_lamella("slice " + ball + plate + "--printer-kind png -o -").out == all));
    CHECK(!std::filesystem::exists("-"));
    CHECK(!std::filesystem::exists("-.partial"));
}

TEST_CASE("what a pipe cannot take is refused, and a reader that goes is a fault") {
    const Outcome goo = run_lamella("slice " + ball + plate + "--printer-kind goo -o -");
    CHECK(goo.code == 2);
    CHECK(mentions(goo.err, "png, sl1, nanodlp, ember"));
    CHECK(goo.out.empty());
    const std::string ember = "slice " + ball + "--printer ember -o - ";
    CHECK(mentions(run_lamella(ember + "--json").err, "--json"));
    CHECK(mentions(run_lamella(ember + "--resume").err, "--resume"));
    CHECK(run_lamella(ember + "--json").code == 2);
    const Folder folder;
    const std::string line = ember + "--layer-height 0.01 2>" + (folder / "err") +
                             " | head -c 10 >/dev/null; exit ${PIPESTATUS[0]}";
    CHECK(shell(line) == 3);
    CHECK(mentions(contents(folder / "err"), "standard output: its reader has gone"));
}

}  // namespace command_extract_test
