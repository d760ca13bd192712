// The archive writer: what is written can be read by libzip, equal entries give equal bytes, and nothing is
// left behind by what fails.
#include "printers/archive/zip_writer.h"

#include <signal.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"

namespace zip_writer_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

TEST_CASE("an archive gives back its entries, in order and byte for byte", "[zip]") {
    const TemporaryFolder folder;
    std::mt19937 random(4);
    std::string noise(300'000, ' ');
    for (char& c : noise) c = static_cast<char>(random());
    const std::vector<std::pair<std::string, std::string>> entries = {
        {"empty", ""}, {"folder/text.txt", std::string(1'000'000, 'a') + "end"}, {"\xc3\xa9/noise", noise}};
    ZipWriter zip(folder / "a.zip");
    for (const auto& [name, content] : entries) {
        zip.begin_entry(name);
        for (std::size_t at = 0; at < content.size();) {
            const std::size_t step = std::min<std::size_t>(1 + random() % 100'000, content.size() - at);
            zip.write(std::string_view(content).substr(at, step));
            at += step;
        }
    }
    CHECK_FALSE(fs::exists(folder / "a.zip"));
    zip.finish();
    CHECK_FALSE(fs::exists(folder / "a.zip.tmp"));
    CHECK(read_zip(folder / "a.zip") == entries);
    CHECK(fs::file_size(folder / "a.zip") < 303'000);
}

TEST_CASE("an archive's bytes do not depend on when or in what pieces it is written", "[zip]") {
    const TemporaryFolder folder;
    const std::string text(200'000, 'x');
    for (const std::size_t step : {text.size(), std::size_t{777}}) {
        ZipWriter zip(folder / std::to_string(step));
        zip.begin_entry("text");
        for (std::size_t at = 0; at < text.size(); at += step) {
            zip.write(std::string_view(text).substr(at, step));
        }
        zip.finish();
    }
    CHECK(read_text(folder / "200000") == read_text(folder / "777"));
}

TEST_CASE("an archive that is not finished leaves nothing behind", "[zip]") {
    const TemporaryFolder folder;
    {
        ZipWriter zip(folder / "a.zip");
        zip.begin_entry("text");
        zip.write("abc");
        CHECK(fs::exists(folder / "a.zip.tmp"));
    }
    CHECK(fs::is_empty(folder / ""));
    CHECK_THROWS_AS(ZipWriter(folder / ".."), InputError);
    CHECK_THROWS_AS(ZipWriter("/nowhere/at/all/a.zip"), FaultError);
    ZipWriter zip(folder / "b.zip");
    CHECK_THROWS_AS(zip.write("outside any entry"), FaultError);
    CHECK_THROWS_AS(zip.begin_entry(""), FaultError);
}

TEST_CASE("an archive that outgrows the disk is a fault, and is removed", "[zip]") {
    const TemporaryFolder folder;
    signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
    rlimit tiny = old;
    tiny.rlim_cur = 5000;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &tiny) == 0);
    std::mt19937 random(1);
    std::string noise(100'000, ' ');
    for (char& c : noise) c = static_cast<char>(random());
    const auto write = [&] {
        ZipWriter zip(folder / "a.zip");
        zip.begin_entry("noise");
        zip.write(noise);
        zip.finish();
    };
    CHECK_THROWS_AS(write(), FaultError);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &old) == 0);
    signal(SIGXFSZ, SIG_DFL);
    CHECK(fs::is_empty(folder / ""));
}

}  // namespace zip_writer_test
