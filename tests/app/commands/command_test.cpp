// The command as its users meet it: exit codes, messages, outputs, interruption and closed pipes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "printers/registry.h"
#include "recipe/settings.h"
#include "tests/app/commands/command_run.h"

namespace command_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

std::size_t count_lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

const std::string ball = "--shape sphere --shape-radius 3 --layer-height 0.1 ";
const std::string small_plate = "--printer-width 200 --printer-height 200 --printer-pixel 0.05 ";
const double ball_volume = 4.0 / 3.0 * 3.14159265358979 * 27;

}  // namespace

TEST_CASE("help and version are everywhere and say what a command takes") {
    const Outcome version = run_lamella("--version");
    CHECK(version.code == 0);
    CHECK(mentions(version.out, "lamella "));
    for (const std::string command :
         {"slice", "preview", "info", "extract", "section", "dump", "supports", "printers", "keys"}) {
        const Outcome help = run_lamella(command + " --help");
        CHECK(help.code == 0);
        CHECK(mentions(help.out, "Examples:"));
        CHECK(mentions(help.out, "lamella " + command));
        CHECK(run_lamella(command + " --version").out == version.out);
    }
    const Outcome slice = run_lamella("slice --help-all");
    for (const auto& setting : settings()) {
        INFO(setting.name());
        CHECK(mentions(slice.out, setting.flag));
    }
    CHECK_FALSE(mentions(slice.out, "{true}"));
    const std::string brief = run_lamella("slice --help").out;
    CHECK(std::ranges::count(brief, '\n') <= 90);
    for (const std::string text :
         {"Usage: lamella slice", "--cell ", "--output", "[foam]", "--help-all", "lamella keys"})
        CHECK(mentions(brief, text));
    CHECK_FALSE(mentions(brief, "--skin-threshold"));
    const std::string foam = run_lamella("keys foam").out;
    CHECK(mentions(foam, "--cell"));
    CHECK_FALSE(mentions(foam, "[skin]"));
    const Outcome wrong = run_lamella("keys foams");
    CHECK(wrong.code == 2);
    CHECK(mentions(wrong.err, "has no section `foams`; its sections: part,"));
    CHECK(mentions(run_lamella("keys").out, "[foam]"));
    CHECK(mentions(run_lamella("printers").out, "png"));
}

TEST_CASE("wrong command lines end with code 2 and a message") {
    for (const std::string wrong :
         {"", "slize", "slice", "slice --cell", "slice --no-such", "slice a.stl b.stl",
          "slice a.stl --threads many", "section --shape sphere --shape-radius 3",
          "dump clouds --cell 1 --beam 0.1", "info no-such-file.stl", "slice no-such-file.toml",
          "dump beams --cell 3 --beam 0.3", "dump beams --cell 3 --beam 0.3 --box 0,0,0,1,1",
          "dump beams --cell 3 --beam 0.3 --box 0,0,0,1,1,nan",
          "dump seeds --cell 3 --beam 0.3 --box 5,0,0,1,1,1", "dump seeds --shape sphere --shape-radius 3"}) {
        const Outcome outcome = run_lamella(wrong);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.starts_with("lamella: "));
        CHECK(outcome.out.empty());
    }
    const Outcome flag = run_lamella("slice " + ball + "--cell three --beam 0.2");
    CHECK(flag.code == 2);
    CHECK(mentions(flag.err, "--cell: column 1: unknown name `three`"));
}

TEST_CASE("a wrong recipe is told with all its lines and makes nothing") {
    const Folder folder;
    write(folder / "wrong.toml", "[part]\nshape = \"sphere\"\nradius = -1\n[skin]\nthicknes = 1\n");
    const Outcome outcome = run_lamella("slice " + folder / "wrong.toml" + " -o " + folder / "out");
    CHECK(outcome.code == 2);
    CHECK(mentions(outcome.err, "wrong.toml:3: part.radius: -1 is too small"));
    CHECK(mentions(outcome.err, "wrong.toml:5: skin.thicknes: unknown key, did you mean `thickness`?"));
    CHECK(tree(folder / "").size() == 1);
}

TEST_CASE("a ball becomes layers in every format, with its volume reported") {
    const Folder folder;
    for (const BackendInfo& backend : backends()) {
        const std::string kind = backend.name;
        CAPTURE(kind);
        const std::string output = folder / ("ball_" + kind);
        const std::string plate = kind == "ember" ? "" : small_plate;  // an Ember has one size
        const Outcome outcome =
            run_lamella("slice " + ball + plate + "--printer " + kind + " --json -o " + output);
        REQUIRE(outcome.code == 0);
        const auto summary = nlohmann::json::parse(outcome.out);
        CHECK(summary["layers"] == 60);
        CHECK(summary["volume_mm3"].get<double>() == Approx(ball_volume).epsilon(0.02));
        CHECK(summary["first_layer_seconds"].get<double>() <= summary["seconds"].get<double>());
        CHECK(summary["peak_memory_bytes"].get<double>() > 1e6);
        CHECK(summary["output"] == output);
        CHECK(summary["identity"].get<std::string>().size() == 32);
        CHECK(fs::exists(output));
        const Outcome again = run_lamella("slice " + ball + plate + "--printer " + kind + " -o " + output);
        CHECK(again.code == 2);
        CHECK(run_lamella("slice " + ball + plate + "--printer " + kind + " --force -o " + output).code == 0);
    }
}

TEST_CASE("a quiet run says nothing, and one thread makes the same bytes as four") {
    const Folder folder;
    const std::string job =
        "slice " + ball + small_plate + "--cell 1.5 --beam 0.2 --skin 0.3 --printer png --quiet ";
    const Outcome one = run_lamella(job + "--threads 1 -o " + folder / "one");
    CHECK(one.code == 0);
    CHECK(one.err.empty());
    CHECK(one.out.empty());
    CHECK(run_lamella(job + "--threads 4 -o " + folder / "four").code == 0);
    CHECK(tree(folder / "one") == tree(folder / "four"));
}

TEST_CASE("memory does not grow with the number of layers") {
    // The address sanitizer holds freed memory back unless told not to, and would be what is measured.
    setenv("ASAN_OPTIONS", "quarantine_size_mb=0:thread_local_quarantine_size_kb=0", 1);
    const Folder folder;
    std::map<int, double> peak;
    for (const int layers : {100, 2000}) {
        const Outcome run = run_lamella(
            "slice --shape box --shape-size 20,20,40 --cell 2.5 --beam 0.3 --skin 0.6 --printer-width 1000 "
            "--printer-height 1000 --printer-pixel 0.025 --threads 2 --json --quiet --layer-height " +
            std::to_string(40.0 / layers) + " -o " + folder / std::to_string(layers));
        REQUIRE(run.code == 0);
        const auto summary = nlohmann::json::parse(run.out);
        REQUIRE(summary["layers"] == layers);
        peak[layers] = summary["peak_memory_bytes"];
    }
    CHECK(peak[2000] < 1.1 * peak[100]);
}

TEST_CASE("layers of a range are the files of the whole run") {
    const Folder folder;
    const std::string part = "slice " + ball + small_plate + "--cell 1.5 --beam 0.2 --skin 0.3 -o ";
    REQUIRE(run_lamella(part + folder / "all").code == 0);
    REQUIRE(run_lamella(part + folder / "low" + " --layers 0:30").code == 0);
    REQUIRE(run_lamella(part + folder / "high" + " --layers 30:60").code == 0);
    const auto all = tree(folder / "all"), low = tree(folder / "low"), high = tree(folder / "high");
    std::size_t compared = 0;
    for (const auto* shard : {&low, &high}) {
        for (const auto& [name, bytes] : *shard) {
            if (!name.ends_with(".png")) continue;
            CHECK(all.at(name) == bytes);
            ++compared;
        }
    }
    CHECK(compared == 60);
}

TEST_CASE("a range of layers is checked against the part") {
    const Folder folder;
    const std::string job = "slice " + ball + small_plate + "--printer png ";
    const Outcome some = run_lamella(job + "--json --layers 10:25 -o " + folder / "some");
    REQUIRE(some.code == 0);
    CHECK(nlohmann::json::parse(some.out)["layers"] == 15);
    for (const std::string wrong : {"5", "25:10", "10:10", "0:61", "-1:4", "a:b", "1:2:3"}) {
        const Outcome outcome = run_lamella(job + "--layers=" + wrong + " -o " + folder / "wrong");
        CHECK(outcome.code == 2);
        CHECK(mentions(outcome.err, "--layers: "));
    }
}

TEST_CASE("an interrupted run says how to go on, and going on makes the same bytes") {
    const Folder folder;
    const std::string job =
        "slice --shape box --shape-size 20,20,40 --layer-height 0.02 --cell 1 --beam 0.12 --printer png "
        "--printer-width 1200 --printer-height 1200 --printer-pixel 0.02 --threads 2 ";
    const auto written = [&] {
        std::size_t files = 0;
        std::error_code ignored;
        for (const auto& entry : fs::recursive_directory_iterator(folder / "", ignored))
            files += entry.is_regular_file();
        return files;
    };
    const Outcome cut = interrupt_lamella(job + "-o " + folder / "cut", [&] { return written() > 12; });
    INFO(cut.err);
    REQUIRE(cut.code == 130);
    CHECK(mentions(cut.err, "--resume"));
    CHECK_FALSE(fs::exists(folder / "cut"));

    const Outcome other = run_lamella(job + "--seed 2 --resume -o " + folder / "cut");
    CHECK(other.code == 2);
    const Outcome resumed = run_lamella(job + "--resume --json -o " + folder / "cut");
    REQUIRE(resumed.code == 0);
    const auto summary = nlohmann::json::parse(resumed.out);
    CHECK(summary["layers_kept"].get<int>() > 0);
    CHECK(summary["layers_kept"].get<int>() + summary["layers"].get<int>() == 2000);
    REQUIRE(run_lamella(job + "--quiet -o " + folder / "whole").code == 0);
    CHECK(tree(folder / "cut") == tree(folder / "whole"));
}

TEST_CASE("info tells size, layers, foam and memory, as text and as JSON") {
    const Outcome json = run_lamella("info " + ball + "--cell 1 --beam 0.1 --skin 0.2 --json");
    REQUIRE(json.code == 0);
    const auto info = nlohmann::json::parse(json.out);
    CHECK(info["layers"] == 60);
    CHECK(info["size_mm"][2].get<double>() == Approx(6));
    CHECK(info["foam"]["expected_seeds_in_bounds"] == 216);
    CHECK(info["foam"]["expected_volume_fraction"].get<double>() > 0.05);
    CHECK(info["memory"]["bytes"].get<double>() > 0);
    const Outcome text = run_lamella("info " + ball + "--cell 1 --beam 0.1");
    CHECK(text.code == 0);
    CHECK(mentions(text.out, "layers    60 of 0.1 mm"));
}

TEST_CASE("dumped seeds and beams are lines of numbers, the same whatever the box they come from") {
    const std::string foam = "--cell 2 --beam 0.2 --seed 5 ";
    const Outcome seeds = run_lamella("dump seeds " + foam + "--box 0,0,0,10,10,10");
    REQUIRE(seeds.code == 0);
    CHECK(count_lines(seeds.out) > 60);
    CHECK(count_lines(seeds.out) < 200);
    std::istringstream lines(seeds.out);
    for (std::string line; std::getline(lines, line);) {
        double x = 0, y = 0, z = 0;
        REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf", &x, &y, &z) == 3);
        CHECK((x >= 0 && x <= 10 && y >= 0 && y <= 10 && z >= 0 && z <= 10));
    }
    const Outcome header = run_lamella("dump beams --header " + foam + "--box 4,4,4,6,6,6");
    CHECK(header.out.starts_with("x0,y0,z0,r0,x1,y1,z1,r1\n"));
    // The beams of a small box are among those of a larger one, digit for digit.
    const Outcome all = run_lamella("dump beams " + foam + "--box 0,0,0,10,10,10");
    std::istringstream few(header.out.substr(header.out.find('\n') + 1));
    for (std::string line; std::getline(few, line);) CHECK(mentions(all.out, line + "\n"));
    const Folder folder;
    CHECK(run_lamella("dump seeds " + foam + "--box 0,0,0,10,10,10 -o " + folder / "seeds.csv").code == 0);
    CHECK(contents(folder / "seeds.csv") == seeds.out);
    CHECK(tree(folder / "").size() == 1);
}

TEST_CASE("a section through a ball's centre is a disc in every format") {
    const Folder folder;
    const std::string job = "section " + ball + small_plate + "--z 0 ";
    const Outcome json = run_lamella(job + "--format json");
    REQUIRE(json.code == 0);
    const auto section = nlohmann::json::parse(json.out);
    CHECK(section["contours"].size() == 1);
    CHECK(section["area_mm2"].get<double>() == Approx(9 * 3.14159265).epsilon(0.02));
    const Outcome svg = run_lamella(job);
    CHECK(svg.out.starts_with("<svg"));
    const Outcome png = run_lamella(job + "-o " + folder / "disc.png");
    CHECK(png.code == 0);
    CHECK(contents(folder / "disc.png").starts_with("\x89PNG"));
    const Outcome missed = run_lamella("section " + ball + "--z 3.5");
    CHECK(missed.code == 2);
    CHECK(mentions(missed.err, "--z: 3.5 misses the part; accepted: a height from -3 to 3 mm"));
}

TEST_CASE("a preview by layers is a folder of pictures of the growing part") {
    const Folder folder;
    const std::string preview = "preview --shape sphere --shape-radius 5 --layer-height 0.1 --size 64 -q ";
    REQUIRE(run_lamella(preview + "--layers 3 -o " + folder / "grown").code == 0);
    for (const char* name : {"0001.png", "0002.png", "0003.png"})
        CHECK(std::filesystem::is_regular_file(folder / "grown/" + name));
    CHECK(!std::filesystem::exists(folder / "grown/0004.png"));
    REQUIRE(run_lamella(preview + "--cut none -o " + folder / "whole.png").code == 0);
    CHECK(contents(folder / "grown/0003.png") == contents(folder / "whole.png"));
    CHECK(contents(folder / "grown/0001.png") != contents(folder / "grown/0002.png"));
    const Outcome many = run_lamella(preview + "--layers 101 -o " + folder / "many");
    CHECK(many.code == 2);
    CHECK(mentions(many.err, "--layers: 101 pictures; accepted: at most 100, one after each layer"));
    CHECK(!std::filesystem::exists(folder / "many"));
    CHECK(run_lamella(preview + "--layers 3 --cut x -o " + folder / "many").code == 2);
}

TEST_CASE("a preview is a picture with the part in its middle") {
    const Folder folder;
    REQUIRE(run_lamella("preview " + ball + "--size 64 --cut none -o " + folder / "ball.png").code == 0);
    CHECK(contents(folder / "ball.png").starts_with("\x89PNG"));
    CHECK(tree(folder / "").size() == 1);
    CHECK(run_lamella("preview " + ball + "--size 64 -o " + folder / "ball.nonsense").code == 2);
}

TEST_CASE("a closed pipe ends a run quietly") {
    const Folder folder;
    const std::string line = std::string("{ ") + LAMELLA_COMMAND +
                             " dump beams --cell 1 --beam 0.1 --box 0,0,0,40,40,40 2>" + folder / "err" +
                             "; echo $? >" + folder / "code" + "; } | head -n 1 >" + folder / "out";
    REQUIRE(std::system(line.c_str()) == 0);
    CHECK(count_lines(contents(folder / "out")) == 1);
    CHECK(contents(folder / "err").empty());
    CHECK(contents(folder / "code") == "0\n");
}

TEST_CASE("a full disk is a fault, told once") {
    const Outcome outcome = run_lamella("dump seeds --cell 1 --beam 0.1 --box 0,0,0,30,30,30 -o /dev/full");
    CHECK(outcome.code == 3);
    CHECK(count_lines(outcome.err) == 1);
}

TEST_CASE("dropped islands are surveyed, told and missing from the layers") {
    const Folder folder;
    const std::string loose = "--foam k-nearest --neighbours 2 --cell 0.9 --beam 0.1 ";
    const std::string job = "slice " + ball + small_plate + "--printer png --json " + loose;
    const Outcome plain = run_lamella(job + "-o " + folder / "plain");
    const Outcome clean = run_lamella(job + "--drop-islands -o " + folder / "clean");
    REQUIRE(plain.code == 0);
    REQUIRE(clean.code == 0);
    const auto with = nlohmann::json::parse(plain.out), without = nlohmann::json::parse(clean.out);
    CHECK_FALSE(with.contains("islands"));
    const auto& islands = without["islands"];
    REQUIRE(islands["islands"].get<int>() > 0);
    CHECK(islands["largest"][0]["volume_mm3"].get<double>() <= islands["island_volume_mm3"].get<double>());
    CHECK(islands["largest"][0]["box_mm"]["lo"][2].get<double>() >= -3);
    CHECK(with["volume_mm3"].get<double>() - without["volume_mm3"].get<double>() ==
          Approx(islands["island_volume_mm3"].get<double>()).epsilon(0.1));
    CHECK(mentions(clean.err, "survey for islands: "));
    CHECK(mentions(clean.err, "islands: " + std::to_string(islands["islands"].get<int>()) + " of "));
    CHECK(mentions(clean.err, "the largest, of "));
    const Outcome info = run_lamella("info --islands --json " + ball + loose);
    REQUIRE(info.code == 0);
    CHECK(nlohmann::json::parse(info.out)["islands"] == islands);
    CHECK(mentions(run_lamella("info --islands " + ball).out, "islands   nothing floats free"));
}

TEST_CASE("the beams of a foam are written beside the layers when the recipe asks") {
    const Folder folder;
    const std::string part = "[part]\nshape = \"sphere\"\nradius = 3\n[layers]\nheight = 0.5\n";
    const std::string output = "[output]\nbeams = \"graph.3mf\"\nbeams_box = [[0, 0, 0], [2, 2, 2]]\n";
    write(folder / "foam.toml", part + output + "[foam]\ncell = 1\nbeam = 0.1\n");
    const std::string job = "slice " + folder / "foam.toml" + " " + small_plate + "--printer png --json -o ";
    const Outcome run = run_lamella(job + folder / "layers");
    REQUIRE(run.code == 0);
    const auto beams = nlohmann::json::parse(run.out)["beams"];
    CHECK(beams["output"] == folder / "graph.3mf");
    CHECK(mentions(run.err, std::to_string(beams["beams"].get<int>()) + " beams between "));
    const std::string dump = "dump beams --box 0,0,0,2,2,2 " + folder / "foam.toml";
    CHECK(beams["beams"].get<std::size_t>() + beams["too_short"].get<std::size_t>() ==
          count_lines(run_lamella(dump).out));
    const Outcome dumped = run_lamella(dump + " --format 3mf -o " + folder / "dumped.3mf");
    CHECK(dumped.code == 0);
    CHECK(contents(folder / "dumped.3mf").starts_with("PK"));
    CHECK(contents(folder / "dumped.3mf") == contents(folder / "graph.3mf"));

    const Outcome again = run_lamella(job + folder / "more");
    CHECK(again.code == 2);
    CHECK(mentions(again.err, "graph.3mf: exists already"));
    CHECK_FALSE(fs::exists(folder / "more"));
    CHECK(run_lamella(job + folder / "layers --force").code == 0);
    CHECK(run_lamella(job + folder / "shard --layers 4:6").code == 0);

    write(folder / "walls.toml", part + output + "[foam]\nkind = \"gyroid\"\ncell = 2\nwall = 0.3\n");
    const Outcome walls = run_lamella("slice --force " + folder / "walls.toml" + " -o " + folder / "walls");
    CHECK(walls.code == 2);
    CHECK(mentions(walls.err, "output.beams / --output-beams: foam.kind gyroid has no beams"));
    CHECK(run_lamella("slice --force " + ball + "--output-beams " + folder / "b.3mf").code == 2);
    CHECK(mentions(run_lamella("slice " + ball + "--output-beams b.txt").err, "the path of a 3MF file"));
    CHECK_FALSE(fs::exists(folder / "b.3mf"));
}

TEST_CASE("every kind of foam with beams can be dumped") {
    const std::string box = " --cell 2 --beam 0.2 --box 0,0,0,6,6,6";
    for (const std::string kind : {"voronoi", "kelvin", "closed --wall 0.1", "lattice --unit-cell bcc",
                                   "k-nearest --neighbours 3 --stretch '1,1,max(1, 1 + z/3)'"}) {
        const Outcome beams = run_lamella("dump beams --foam " + kind + box);
        CHECK(beams.code == 0);
        CHECK(count_lines(beams.out) > 50);
        const bool seeds = !mentions(kind, "lattice");
        CHECK(run_lamella("dump seeds --foam " + kind + box).code == (seeds ? 0 : 2));
    }
}

TEST_CASE("entries that nothing uses are told in one line") {
    const Folder folder;
    const std::string path = folder / "unused.toml";
    write(path,
          "[[field]]\nname = \"spare\"\nformula = \"x\"\n"
          "[[grading]]\nname = \"a\"\nkind = \"formula\"\nformula = \"1 + 0*b\"\n"
          "[[grading]]\nname = \"b\"\nkind = \"constant\"\nvalue = 2\n"
          "[[grading]]\nname = \"lost\"\nkind = \"formula\"\nformula = \"b + x\"\n"
          "[part]\nshape = \"sphere\"\nradius = 3\n[foam]\ncell = \"a\"\nbeam = 0.1\n");
    const std::string note = path + ": nothing uses [[field]] `spare`, [[grading]] `lost`\n";
    CHECK(run_lamella("info " + path).err == note);
    CHECK(run_lamella("dump seeds " + path).err == note);
    const std::string slice = "slice " + path + " " + small_plate + "--layers 0:1 --printer png ";
    CHECK(mentions(run_lamella(slice + "-o " + folder / "one").err, note));
    CHECK(run_lamella(slice + "--quiet -o " + folder / "two").err.empty());
}

TEST_CASE("elements are written as copies of meshes", "[elements]") {
    const Folder folder;
    const std::string file = (folder.path() / "leaves.3mf").string();
    const std::string examples = LAMELLA_SOURCE_DIR "/examples/";
    REQUIRE(run_lamella("dump elements " + examples + "leaf_console.toml --format 3mf -o " + file).code == 0);
    // Sixty leaves of one area, 3 mm high, and nothing else.
    const auto volume = [](const std::string& of) {
        return nlohmann::json::parse(run_lamella("info --json " + of).out)["mesh"]["volume_mm3"]
            .get<double>();
    };
    const double all = volume(file);
    std::istringstream model(run_lamella("dump elements " + examples + "leaf_console.toml").out);
    CHECK(count_lines(model.str()) == 60);
    CHECK(all / 60 / 3 == Approx(61.6).epsilon(0.01));
    const Outcome skin =
        run_lamella("dump elements " + examples + "leaf_shade.toml --format 3mf -o " + file + "2");
    CHECK(skin.code == 2);
    CHECK(mentions(skin.err, "elements of a skin bend with it"));
    CHECK(run_lamella("dump elements " + examples + "leaf_console.toml --format 3mf").code == 2);
}

}  // namespace command_test
