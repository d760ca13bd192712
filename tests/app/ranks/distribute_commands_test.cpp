// Checks and stiffness by several processes: mpirun as users start it, against one process.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/ranks/mpirun.h"

namespace distribute_commands_test {

#ifdef LAMELLA_MPIRUN
using namespace lamella;

namespace {

/// Bare foam: thin, hanging, with pieces on their own.
const std::string faulty =
    "--shape box --shape-size 6,6,5 --cell 2 --beam 0.3 --layer-height 0.1 --threads 1 -q ";
/// The same in a shell, with what holds it.
const std::string held = faulty + "--skin 0.6 --support pillars ";

}  // namespace

TEST_CASE("a check by several processes says what one says", "[ranks][check][slow]") {
    const Folder folder;
    const std::string page = folder / "page.html";
    const auto check = [&](const std::string& part, const std::vector<int>& sizes) {
        std::filesystem::remove(page);
        const Outcome text = run_by(0, "check " + part + "--report " + page, folder);
        const std::string pictures = contents(page);
        REQUIRE(text.code == 1);
        REQUIRE(text.out.size() > 500);
        REQUIRE(pictures.size() > 10000);
        for (const int size : sizes) {
            std::filesystem::remove(page);
            const Outcome spread = run_by(size, "check " + part + "--report " + page, folder);
            INFO(part << size << "\n" << spread.err);
            CHECK(spread.code == 1);
            CHECK(spread.out == text.out);
            CHECK(contents(page) == pictures);
            CHECK(times(spread.err, "cannot be printed as it is") == 1);
        }
    };
    check(faulty + "--printer marlin ", {1, 2, 3, 4});
    check(held + "--printer prusa-sl1s ", {3});
    const std::string json = "check --json --printer marlin " + held;
    CHECK(run_by(2, json, folder).out == run_by(0, json, folder).out);
}

TEST_CASE("a part that passes its check passes by several processes", "[ranks][check]") {
    const Folder folder;
    const std::string block = "check --shape box --shape-size 9,9,9 --layer-height 0.5 --printer marlin -q";
    const Outcome alone = run_by(0, block, folder), spread = run_by(3, block, folder);
    CHECK(alone.code == 0);
    CHECK(spread.code == 0);
    CHECK(spread.out == alone.out);
    CHECK(spread.err.empty());
}

TEST_CASE("several processes slice and check at once", "[ranks][check]") {
    using Json = nlohmann::json;
    const Folder folder;
    // Two machines: two outputs, each with a check of its own beside it.
    const auto slice = [&](int size, const std::string& more) {
        const std::string name = folder / ("n" + std::to_string(size));
        const Outcome outcome = run_by(size,
                                       "slice --check --json " + held + "--printer marlin -o " + name +
                                           ".gcode -o " + name + ".sl1@prusa-sl1s " + more,
                                       folder);
        INFO(outcome.err);
        CHECK(outcome.code == 1);
        CHECK(times(outcome.err, "all layers have been written nevertheless") == 1);
        const Json summary = Json::parse(outcome.out);
        CHECK(summary["checks"].size() == 2);
        return std::tuple(summary["checks"].dump(), contents(name + ".gcode"), contents(name + ".sl1"));
    };
    const auto alone = slice(0, "");
    CHECK(std::get<1>(alone).size() > 10000);
    CHECK(std::get<2>(alone).size() > 10000);
    for (const int size : {2, 3}) CHECK(slice(size, "") == alone);
    CHECK(slice(2, "--force") == alone);
}

TEST_CASE("what several processes cannot do is told once", "[ranks]") {
    const Folder folder;
    const auto refused = [&](const std::string& arguments, const std::string& why) {
        const Outcome outcome = run_by(2, arguments, folder);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(times(outcome.err, why) == 1);
    };
    const std::string slice = "slice " + faulty + "-o " + folder / "x.svg ";
    refused(slice + "--check --layers 0:4", "--check: needs all layers");
    refused(slice + "--shard " + folder / "x.shard",
            "--shard: under mpirun the processes' layers are joined already");
    refused(slice + "--plugin none.so",
            "--plugin: layers rendered by a plugin cannot be sent to another process");
    refused("check " + faulty + "--beam -1", "--beam: ");
    refused("check " + folder / "none.toml", "none.toml");
    refused("homogenize --table --cell 1", "--beam: missing");
    refused("homogenize --table --cell 1 --beam 0.2 --ratios 0.2,0.1", "--ratios: ");
    refused("homogenize -q --cell 1 --beam 0.2 --stretch 1,1,2", "the foam is not periodic");
}

TEST_CASE("tables and samples of a foam by several processes are those of one", "[ranks][elasticity]") {
    const Folder folder;
    const std::string table =
        "homogenize --table --foam kelvin --cell 1 --beam 0.1 --jitter 0.3 --rve 16 --samples 2 --threads 1 "
        "--ratios 0.18,0.24 ";
    const std::string samples =
        "homogenize --cell 1 --beam 0.2 --rve 16 --samples 3 --threads 1 --json --plot " + folder / "e.svg ";
    for (const std::string& command : {table, samples}) {
        const Outcome alone = run_by(0, command + "-q", folder);
        REQUIRE(alone.code == 0);
        REQUIRE(alone.out.size() > 100);
        const std::string plot = command == samples ? contents(folder / "e.svg") : "";
        for (const int size : {1, 2, 3, 4}) {
            const Outcome spread = run_by(size, command, folder);
            INFO(spread.err);
            CHECK(spread.code == 0);
            CHECK(spread.out == alone.out);
            if (!plot.empty()) CHECK(contents(folder / "e.svg") == plot);
            // One process tells how far all have come.
            const std::size_t results = command == table ? 2 : 1;
            CHECK(times(spread.err, "100 %") == results);
        }
        CHECK(run_by(3, command + "-q", folder).err.empty());
    }
}
#endif

}  // namespace distribute_commands_test
