// Shards: packed layers that join to what one run writes, and what is said of damaged or missing ones.
#include "printers/archive/shard_file.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"

namespace shard_file_test {

using namespace lamella;

namespace {

const std::string foam = "--shape box --shape-size 8,8,4 --cell 2 --beam 0.3 --layer-height 0.2";

std::string slice(const std::string& more) { return "slice " + foam + " " + more + " -q"; }

/// Two shards of the job's 20 layers, for an output of this name and machine.
void make_shards(const Folder& folder, const std::string& output, const std::string& printer) {
    const std::string common = "--printer " + printer + " -o " + folder / output;
    REQUIRE(run_lamella(slice(common + " --force --layers :7 --shard " + folder / "a.shard")).code == 0);
    REQUIRE(run_lamella(slice(common + " --force --layers 7: --shard " + folder / "b.shard")).code == 0);
}

std::string join(const Folder& folder, const std::string& output, const std::string& printer,
                 const std::string& shards) {
    return "join " + foam + " --printer " + printer + " -q -o " + folder / output + " --shards " + shards;
}

}  // namespace

TEST_CASE("shards join to the bytes of one run, in every format", "[shard]") {
    const std::vector<std::pair<std::string, std::string>> outputs{
        {"part.sl1", "prusa-sl1s"},   {"part.gcode", "marlin"},    {"stack", "generic-8k"},
        {"part.svg", "svg"},          {"part.cli", "cli"},         {"part.3mf", "3mf"},
        {"part.goo", "goo"},          {"part.nanodlp", "nanodlp"}, {"part.tar.gz", "ember"},
        {"part.gcode", "grbl-laser"}, {"sheets", "dxf"},           {"volume.3mf", "image3d"}};
    for (const auto& [output, printer] : outputs) {
        INFO(printer);
        const Folder folder;
        std::filesystem::create_directories(folder.path() / "whole");
        REQUIRE(run_lamella(slice("--printer " + printer + " -o " + folder / ("whole/" + output))).code == 0);
        make_shards(folder, output, printer);
        std::filesystem::create_directories(folder.path() / "joined");
        REQUIRE(run_lamella(
                    join(folder, "joined/" + output, printer, folder / "b.shard" + " " + folder / "a.shard"))
                    .code == 0);
        CHECK((tree(folder.path() / "joined") == tree(folder.path() / "whole")));
        CHECK_FALSE(tree(folder.path() / "joined").empty());
    }
}

TEST_CASE("several outputs join from one set of shards", "[shard]") {
    const Folder folder;
    const std::string outputs = "-o " + folder / "a.sl1" + "@prusa-sl1s -o " + folder / "a.svg";
    REQUIRE(run_lamella(slice(outputs)).code == 0);
    REQUIRE(run_lamella(slice(outputs + " --layers :9 --shard " + folder / "1.shard")).code == 0);
    REQUIRE(run_lamella(slice(outputs + " --layers 9: --shard " + folder / "2.shard")).code == 0);
    const std::string sl1 = contents(folder / "a.sl1"), svg = contents(folder / "a.svg");
    REQUIRE(run_lamella("join " + foam + " -q --force " + outputs + " --shards " + folder / "1.shard" + " " +
                        folder / "2.shard")
                .code == 0);
    CHECK((contents(folder / "a.sl1") == sl1));
    CHECK((contents(folder / "a.svg") == svg));
}

TEST_CASE("shards that do not fit are refused with what is wrong", "[shard]") {
    const Folder folder;
    make_shards(folder, "part.svg", "svg");
    const std::string a = folder / "a.shard", b = folder / "b.shard";
    const auto told = [&](const std::string& shards, const std::string& more = "") {
        const Outcome outcome = run_lamella(join(folder, "part.svg", "svg", shards) + " " + more);
        CHECK(outcome.code == 2);
        CHECK_FALSE(std::filesystem::exists(folder / "part.svg"));
        return outcome.err;
    };
    CHECK_THAT(told(a), Catch::Contains("layers 7:20 are in none of the shards"));
    CHECK_THAT(told(b), Catch::Contains("layers 0:7 are in none of the shards"));
    CHECK_THAT(told(a + " " + b + " " + a), Catch::Contains("layers 0:7 are in another shard, too"));
    CHECK_THAT(told(a + " " + b, "--beam 0.31"), Catch::Contains("is of another job"));
    CHECK_THAT(told(a + " " + b, "--printer generic-8k"), Catch::Contains("is of another job"));
    CHECK_THAT(told(a + " " + b, "-o " + folder / "x.cli"), Catch::Contains("other outputs or printer"));
    CHECK_THAT(told(a + " " + b, "--layers 0:3"), Catch::Contains("join always uses all layers"));
    CHECK_THAT(told(folder / "none"), Catch::Contains("cannot be opened"));
    write(folder / "text", "solid ascii\n");
    CHECK_THAT(told(folder / "text"), Catch::Contains("is no shard"));

    const std::string whole = contents(a);
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 40) {
        write(a, whole.substr(0, size));
        told(a + " " + b);
    }
    std::string damaged = whole;
    damaged[whole.size() - 40] = static_cast<char>(damaged[whole.size() - 40] ^ 1);
    write(a, damaged);
    CHECK(run_lamella(join(folder, "part.svg", "svg", a + " " + b)).code == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "part.svg"));
}

TEST_CASE("layers of a shard that are no whole numbers in range are refused", "[shard]") {
    const Folder folder;
    for (const char* number : {"1e300", "0.5", "-1e19", "4294967297", "null"}) {
        INFO(number);
        std::ofstream(folder / "a.shard")
            << "lamella shard 1 {\"identity\":\"a\",\"settings\":\"b\",\"first_layer\":" << number
            << ",\"last_layer\":4}\n";
        CHECK_THROWS_WITH(ShardFile(folder / "a.shard"), Catch::Contains("has a damaged first line"));
    }
}

TEST_CASE("a parcel that is cut or stretched is refused", "[shard]") {
    std::string text = "lines";
    std::vector<double> numbers{1, 2, 3};
    int count = 7;
    Archive packed;
    packed(text, numbers, count);
    for (std::size_t size = 0; size <= packed.bytes().size() + 1; ++size) {
        std::string bytes = packed.bytes();
        bytes.resize(size);
        Archive opened(bytes);
        std::string other_text;
        std::vector<double> other_numbers;
        int other_count = 0;
        const auto open = [&] {
            opened(other_text, other_numbers, other_count);
            opened.finish();
        };
        if (size == packed.bytes().size()) {
            CHECK_NOTHROW(open());
            CHECK(other_text == text);
            CHECK(other_numbers == numbers);
            CHECK(other_count == count);
        } else {
            CHECK_THROWS_AS(open(), FaultError);
        }
    }
}

}  // namespace shard_file_test
