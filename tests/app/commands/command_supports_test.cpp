// Supports as users of the command meet them: what they are told, what is written, and what is kept.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/commands/boxes_mesh.h"
#include "tests/app/commands/command_run.h"

namespace command_supports_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

const std::string koala =
    std::string(LAMELLA_SOURCE_DIR) + "/examples/models/koala_mm.obj --layer-height 0.2 ";
const std::string ball = "--shape sphere --shape-radius 8 --layer-height 0.1 ";

/// A ball in a closed cavity that is 0.8 mm larger all round.
std::string ball_in_a_box(const Folder& folder, const std::string& support) {
    write(folder / "cavity.toml",
          "[part]\nshape = \"box\"\nsize = [20, 20, 20]\n"
          "[[field]]\nname = \"cavity\"\nkind = \"sphere\"\nradius = 8\n"
          "[[field]]\nname = \"kernel\"\nkind = \"sphere\"\nradius = 7.2\n"
          "[[region]]\nfield = \"cavity\"\nmake = \"empty\"\n[[region]]\nfield = \"kernel\"\nmake = "
          "\"solid\"\n[layers]\nheight = 0.2\n[printer]\nprofile = \"marlin\"\n[support]\n" +
              support);
    return folder / "cavity.toml";
}

std::string table_in(const Folder& folder) {
    write(folder / "table.obj", boxes_obj(table()));
    return folder / "table.obj" + " --layer-height 0.2 ";
}

double distance(const Json& a, const Json& b) {
    const auto at = [](const Json& v) { return dvec3(v.at(0), v.at(1), v.at(2)); };
    return glm::distance(at(a), at(b));
}

/// The layers of a G-code file without the first and the last, which begin and end the print, by height.
std::map<std::string, std::string> middle_layers(const std::string& gcode) {
    const std::string mark = ";LAYER_CHANGE\n";
    std::map<std::string, std::string> layers;
    std::size_t begin = gcode.find(mark);
    REQUIRE(begin != std::string::npos);
    begin = gcode.find(mark, begin + 1);
    for (std::size_t end = 0; (end = gcode.find(mark, begin + 1)) != std::string::npos; begin = end) {
        const std::string layer = gcode.substr(begin + mark.size(), end - begin - mark.size());
        layers[layer.substr(0, layer.find('\n'))] = layer;
    }
    return layers;
}

std::uintmax_t bytes_in(const fs::path& folder) {
    std::uintmax_t sum = 0;
    std::error_code ignored;
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored)) {
        if (entry.is_regular_file(ignored)) sum += entry.file_size(ignored);
    }
    return sum;
}

}  // namespace

TEST_CASE("lamella supports tells what it plans, as text") {
    const Folder folder;
    const std::string job = "supports " + koala + "--printer marlin --plans " + folder / "plans ";
    const Outcome first = run_lamella(job);
    REQUIRE(first.code == 0);
    for (const std::string line : {"supports  ", " bridges and ", "points    ", " for overhang", "hanging   ",
                                   "lengths   bridges ", "material  "})
        CHECK(mentions(first.out, line));
    CHECK_FALSE(mentions(first.out, "as planned before"));
    CHECK(mentions(first.err, "survey for supports: "));
    CHECK(tree(folder / "plans").size() == 1);
    const Outcome again = run_lamella(job + "--quiet");
    CHECK(mentions(again.out, ", as planned before\n"));
    CHECK(again.err.empty());
    const Outcome written = run_lamella(job + "--quiet -o " + folder / "text");
    CHECK(written.out.empty());
    CHECK(contents(folder / "text") == again.out);
    const Outcome other = run_lamella(job + "--support pillars --quiet");
    CHECK(mentions(other.out, " on 0 bridges and "));
    CHECK(tree(folder / "plans").size() == 2);
}

TEST_CASE("lamella supports gives every piece as JSON, and every held point has a tip") {
    const Folder folder;
    for (const std::string kind : {"bridges", "pillars"}) {
        for (const std::string& part : {koala, table_in(folder), ball}) {
            const Outcome run =
                run_lamella(fmt::format("supports {}--printer marlin --json -q --support {}", part, kind));
            REQUIRE(run.code == 0);
            const Json plan = Json::parse(run.out);
            CHECK(plan["unheld"] == 0);
            CHECK(plan["topples_at_mm"].is_null());
            CHECK(plan["volume_mm3"].get<double>() > 0);
            CHECK(plan["identity"].get<std::string>().size() == 32);
            CHECK((kind == "bridges" || plan["bridges"].empty()));
            REQUIRE_FALSE(plan["points"].empty());
            for (const Json& point : plan["points"]) {
                CHECK(point["held"] == true);
                CHECK(std::set<std::string>{"overhang", "island", "span", "stability"}.contains(
                    point["reason"]));
                double nearest = 1e9;
                for (const Json& piece : plan["connectors"])
                    nearest = std::min({nearest, distance(piece["from_mm"], point["at_mm"]),
                                        distance(piece["to_mm"], point["at_mm"])});
                CHECK(nearest <= 0.6);
            }
            double length = 0;
            for (const Json& bar : plan["bridges"]) {
                CHECK(bar["from_mm"][2] == bar["to_mm"][2]);
                CHECK(distance(bar["from_mm"], bar["to_mm"]) <= 12 + 1e-6);
                length += distance(bar["from_mm"], bar["to_mm"]);
            }
            CHECK(length == Approx(plan["bridges_length_mm"].get<double>()));
            for (const Json& pillar : plan["pillars"]) {
                CHECK(pillar["bottom_mm"].get<double>() < pillar["top_mm"].get<double>());
                if (pillar["on"] == "bed") CHECK(pillar["bottom_mm"] == plan["bed_mm"]);
            }
        }
    }
}

TEST_CASE("points that nothing can be led to are told, with exit code 1") {
    const Folder folder;
    CHECK(run_lamella("supports " + ball_in_a_box(folder, "")).code == 0);
    // Tips that end further from the part than the cavity is wide have no room.
    const std::string recipe = ball_in_a_box(folder, "gap = 1\n");
    const Outcome text = run_lamella("supports -q " + recipe);
    CHECK(text.code == 1);
    CHECK(mentions(text.out, "points cannot be reached without touching the part, the lowest at (-0.00, "));
    CHECK(mentions(text.err, "lamella: "));
    CHECK(mentions(text.err, " points are not held"));
    const Outcome json = run_lamella("supports -q --json " + recipe);
    CHECK(json.code == 1);
    const Json plan = Json::parse(json.out);
    CHECK(plan["unheld"].get<std::size_t>() > 0);
    const auto unheld = std::count_if(plan["points"].begin(), plan["points"].end(),
                                      [](const Json& point) { return point["held"] == false; });
    CHECK(plan["unheld"] == unheld);
    // Slicing goes on, and says so.
    const Outcome slice = run_lamella("slice " + recipe + " -o " + folder / "cavity.gcode");
    CHECK(slice.code == 0);
    CHECK(mentions(slice.err, "points cannot be reached without touching the part"));
}

TEST_CASE("wrong supports are refused before anything is planned or written") {
    const Folder folder, model;
    const std::string part = table_in(model) + "--printer marlin ";
    const std::string plans = " --plans " + folder / "plans";
    for (const auto& [wrong, message] : std::vector<std::pair<std::string, std::string>>{
             {"--support pilars", "--support: \"pilars\" is unknown, did you mean `pillars`?"},
             {"--support-spacing 0", "--support-spacing: 0 is too small"},
             {"--support-spacing wide", "--support-spacing: "},
             {"--support-tip 3", "--support-tip"},
             {"--support-grey 2", "--support-grey: 2 is too large"},
             {"--threads -1", "--threads"}}) {
        for (const std::string command : {"supports ", "slice "}) {
            INFO(command << wrong);
            const Outcome run =
                run_lamella(fmt::format("{}{}{}{} -o {}", command, part, wrong, plans, folder / "out"));
            CHECK(run.code == 2);
            CHECK(mentions(run.err, message));
            CHECK(run.out.empty());
        }
    }
    for (const std::string lift : {"0", "3.05"}) {
        const std::string job = fmt::format("slice {}--support bridges --support-lift {}{} -o {}", part, lift,
                                            plans, folder / "out");
        for (const std::string range : {"5", "0:400", "30:20"}) {
            const Outcome run = run_lamella(fmt::format("{} --layers {}", job, range));
            CHECK(run.code == 2);
            CHECK(mentions(run.err, lift == "0" ? "B <= 60 " : "B <= 76 "));
            CHECK_FALSE(mentions(run.err, "survey for supports"));
        }
    }
    CHECK(run_lamella("supports --plans " + folder / "plans").code == 2);
    CHECK(tree(folder.path()).empty());
}

TEST_CASE("help says what supports take and what their exit code means") {
    const std::string help = run_lamella("supports --help").out;
    for (const std::string text : {"--plans DIR", "--json", "--support ", "--support-spacing", "Exit code 1",
                                   "lamella supports model.stl"})
        CHECK(mentions(help, text));
    CHECK(mentions(run_lamella("slice --help").out, "--plans DIR"));
    const std::string keys = run_lamella("keys").out;
    CHECK(mentions(keys, "[support]"));
    CHECK(mentions(keys, "blocker"));
    CHECK(mentions(run_lamella("--help").out, "supports"));
}

TEST_CASE("shards of a supported job are the whole, and share one plan") {
    const Folder folder;
    const std::string plans = "--plans " + folder / "plans ";
    for (const std::string printer :
         {"svg --no-printer-one-file", "png --printer-width 800 --printer-height 800"}) {
        const std::string job = fmt::format("slice {}--support bridges --printer {} ", ball, printer);
        const std::string at = folder / printer.substr(0, 3);
        REQUIRE(run_lamella(fmt::format("{}{}-o {}_all", job, plans, at)).code == 0);
        for (const std::string range : {"0:50", "50:160"}) {
            const Outcome shard = run_lamella(
                fmt::format("{}{}--layers {} -o {}_{}", job, plans, range, at, range.substr(0, 1)));
            REQUIRE(shard.code == 0);
            CHECK(mentions(shard.err, "as planned before"));
            CHECK_FALSE(mentions(shard.err, "survey for supports"));
        }
        const auto all = tree(at + "_all"), low = tree(at + "_0"), high = tree(at + "_5");
        const std::string ending = "." + printer.substr(0, 3);
        int layers = 0;
        for (const auto& [name, bytes] : all) {
            if (!name.ends_with(ending)) continue;
            ++layers;
            INFO(name);
            REQUIRE(low.contains(name) != high.contains(name));
            CHECK((low.contains(name) ? low : high).at(name) == bytes);
        }
        CHECK(layers == 160);
        // Without a plan the same is found again.
        REQUIRE(run_lamella(fmt::format("{}--plans '' -o {}_fresh", job, at)).code == 0);
        CHECK(tree(at + "_fresh") == all);
        CHECK(tree(folder / "plans").size() == (ending == ".svg" ? 1 : 2));
    }
}

TEST_CASE("G-code of supported shards has the layers of the whole") {
    const Folder folder;
    const std::string job = "slice " + table_in(folder) + "--support bridges --printer marlin --json ";
    const std::string kept = job + "--plans " + folder / "plans" + " -o ";
    const Outcome all = run_lamella(kept + folder / "all.gcode");
    REQUIRE(all.code == 0);
    const Json summary = Json::parse(all.out);
    CHECK(summary["layers"] == 60);
    CHECK(summary["volume_mm3"].get<double>() == Approx(25 * 10 + 400 * 2).epsilon(0.01));
    const double supports = summary["support_volume_mm3"];
    CHECK(supports > 50);
    CHECK(supports ==
          Approx(Json::parse(run_lamella("supports --json -q " + table_in(folder) + "--printer marlin")
                                 .out)["volume_mm3"]
                     .get<double>())
              .epsilon(0.05));
    CHECK(mentions(all.err, " of supports, "));
    const std::string gcode = contents(folder / "all.gcode");
    CHECK(mentions(gcode, ";TYPE:Support material\n"));
    REQUIRE(run_lamella(kept + folder / "low.gcode --layers 0:30").code == 0);
    REQUIRE(run_lamella(kept + folder / "high.gcode --layers 30:60").code == 0);
    const auto whole = middle_layers(gcode);
    std::size_t compared = 0;
    for (const std::string shard : {"low.gcode", "high.gcode"}) {
        for (const auto& [height, text] : middle_layers(contents(folder / shard))) {
            INFO(shard << " " << height);
            CHECK(whole.at(height) == text);
            ++compared;
        }
    }
    CHECK(compared == 56);
    REQUIRE(run_lamella(job + "--plans '' -o " + folder / "fresh.gcode").code == 0);
    CHECK(contents(folder / "fresh.gcode") == gcode);
}

TEST_CASE("a supported run that was interrupted goes on with its plan to the same bytes") {
    const Folder folder;
    const std::string part = "--shape sphere --shape-radius 8 --layer-height 0.02 --threads 2 ";
    for (const std::string printer :
         {"png --printer-width 1600 --printer-height 1600 --printer-pixel 0.0125", "marlin"}) {
        INFO(printer);
        const std::string name = printer.substr(0, 3), plans = folder / (name + "_plans");
        const std::string job =
            fmt::format("slice {}--support bridges --printer {} --plans {} ", part, printer, plans);
        fs::create_directory(folder / name);
        const Outcome cut = interrupt_lamella(job + "-o " + folder / name + "/cut",
                                              [&] { return bytes_in(folder / name) > 100000; });
        INFO(cut.err);
        REQUIRE(cut.code == 130);
        CHECK(mentions(cut.err, "--plans " + plans));
        CHECK(mentions(cut.err, "--resume"));
        CHECK_FALSE(fs::exists(folder / name + "/cut"));
        const Outcome resumed = run_lamella(job + "--resume --json -o " + folder / name + "/cut");
        REQUIRE(resumed.code == 0);
        CHECK(mentions(resumed.err, "as planned before"));
        CHECK(Json::parse(resumed.out)["layers_kept"].get<int>() > 0);
        REQUIRE(run_lamella(job + "-q -o " + folder / name + "/whole").code == 0);
        if (name == "png") {
            CHECK(tree(folder / name + "/cut") == tree(folder / name + "/whole"));
        } else {
            CHECK(contents(folder / name + "/cut") == contents(folder / name + "/whole"));
        }
    }
}

TEST_CASE("plans lie in the user's cache, and a cache that cannot be written to stops nothing") {
    const Folder folder;
    const std::string job = "supports -q " + ball + "--printer marlin >/dev/null";
    REQUIRE(std::system(command_line(job, folder / "cache").c_str()) == 0);
    const auto kept = tree(folder / "cache");
    REQUIRE(kept.size() == 1);
    CHECK(kept.begin()->first.starts_with("lamella/plans/"));
    CHECK(kept.begin()->first.ends_with(".json"));
    CHECK(std::system(command_line(job, "/dev/null").c_str()) == 0);
    CHECK(std::system(
              ("env -u HOME -u XDG_CACHE_HOME " + std::string(LAMELLA_COMMAND) + " " + job).c_str()) == 0);
}

TEST_CASE("pictures and sections show supports") {
    const Folder folder;
    const std::string part = table_in(folder) + "--printer marlin ";
    const std::string picture = "preview --size 64 --cut none -q " + part + "-o " + folder / "a.png";
    REQUIRE(run_lamella(picture).code == 0);
    const std::string bare = contents(folder / "a.png");
    REQUIRE(run_lamella(picture + " --support bridges").code == 0);
    CHECK(contents(folder / "a.png") != bare);
    const std::string section = "section --z 5 --format json " + part;
    const Json with = Json::parse(run_lamella(section + "--support bridges").out);
    const Json without = Json::parse(run_lamella(section).out);
    CHECK(with["area_mm2"].get<double>() == Approx(25).epsilon(0.01));
    CHECK(without["area_mm2"].get<double>() == Approx(25).epsilon(0.01));
    CHECK(with.dump() != without.dump());
}

TEST_CASE("memory with supports does not grow with the number of layers") {
    // The address sanitizer holds freed memory back unless told not to, and would be what is measured.
    setenv("ASAN_OPTIONS", "quarantine_size_mb=0:thread_local_quarantine_size_kb=0", 1);
    const Folder folder;
    std::map<int, double> peak;
    for (const int layers : {500, 5000}) {
        const Outcome run = run_lamella(
            "slice --shape capsule --shape-radius 5 --shape-height 40 --support bridges --support-overhang "
            "0.1 "
            "--printer png --printer-width 400 --printer-height 400 --printer-pixel 0.05 --threads 2 --json "
            "--quiet --layer-height " +
            std::to_string(40.0 / layers) + " -o " + folder / std::to_string(layers));
        REQUIRE(run.code == 0);
        const auto summary = Json::parse(run.out);
        REQUIRE(summary["layers"] == layers);
        CHECK(summary["support_volume_mm3"].get<double>() > 1);
        peak[layers] = summary["peak_memory_bytes"];
    }
    CHECK(peak[5000] < 1.08 * peak[500]);
}

}  // namespace command_supports_test
