// Files and their journals: what may be replaced, what may be continued, and what a full disk does.
#include "printers/archive/unfinished_file.h"

#include <signal.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/printers/common/plane_solids.h"

namespace unfinished_file_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {
const JobStamp stamp{"identity", "settings", {0, 4}};
}

TEST_CASE("a full device is a fault that names the file", "[unfinished_file]") {
    OutputFile file = OutputFile::create("/dev/null");
    file.write("goes nowhere");
    OutputFile full = OutputFile::create("/dev/full");
    CHECK_THROWS_WITH(full.write("x"), Catch::Contains("/dev/full") && Catch::Contains("No space left"));
    CHECK_THROWS_AS(OutputFile::create("/nowhere/at/all"), FaultError);
}

TEST_CASE("a file that outgrows the disk keeps its complete layers", "[unfinished_file]") {
    const TemporaryFolder folder;
    signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
    {
        UnfinishedFile file(folder / "out", false);
        CHECK(file.begin(stamp, false) == 0);
        file.commit("header\n", 0);
        file.commit(std::string(500, 'a'), 1, {{"x", 1}});
        rlimit tiny = old;
        tiny.rlim_cur = 600;
        REQUIRE(setrlimit(RLIMIT_FSIZE, &tiny) == 0);
        CHECK_THROWS_AS(file.commit(std::string(500, 'b'), 2), FaultError);
        REQUIRE(setrlimit(RLIMIT_FSIZE, &old) == 0);
    }
    signal(SIGXFSZ, SIG_DFL);
    CHECK(fs::file_size(folder / "out.partial") == 600);
    UnfinishedFile file(folder / "out", false);
    CHECK(file.begin(stamp, true) == 1);
    file.restore([](const auto& state) { CHECK(state.at("x") == 1); });
    CHECK_THROWS_WITH(
        file.restore([](const auto& state) { return state.at("x").template get<std::string>(); }),
        Catch::Contains("out.partial.journal is damaged") && Catch::Contains("--force"));
    file.commit(std::string(500, 'b'), 2);
    file.end("end\n");
    CHECK(read_text(folder / "out") == "header\n" + std::string(500, 'a') + std::string(500, 'b') + "end\n");
}

TEST_CASE("an existing file is replaced only when told", "[unfinished_file]") {
    const TemporaryFolder folder;
    write_text(folder / "out", "old");
    CHECK_THROWS_WITH(UnfinishedFile(folder / "out", false).begin(stamp, false),
                      Catch::Contains("exists already") && Catch::Contains("--force"));
    CHECK_THROWS_AS(UnfinishedFile(folder / "out", false).begin(stamp, true), InputError);
    UnfinishedFile file(folder / "out", true);
    file.begin(stamp, false);
    file.commit("new", 0);
    CHECK(read_text(folder / "out") == "old");
    file.end("er");
    CHECK(read_text(folder / "out") == "newer");
    fs::create_directories(folder / "folder");
    CHECK_THROWS_AS(UnfinishedFile(folder / "folder", true).begin(stamp, false), InputError);
}

TEST_CASE("an unfinished file is neither overwritten nor continued by another job", "[unfinished_file]") {
    const TemporaryFolder folder;
    {
        UnfinishedFile file(folder / "out", false);
        file.begin(stamp, false);
        file.commit("header\n", 0);
        file.commit("layer\n", 1);
    }
    const auto begin = [&](const JobStamp& other, bool resume) {
        return UnfinishedFile(folder / "out", false).begin(other, resume);
    };
    CHECK_THROWS_WITH(begin(stamp, false), Catch::Contains("--resume"));
    CHECK_THROWS_WITH(begin({"other", "settings", {0, 4}}, true), Catch::Contains("another job"));
    CHECK_THROWS_WITH(begin({"identity", "other", {0, 4}}, true), Catch::Contains("other printer settings"));
    CHECK_THROWS_WITH(begin({"identity", "settings", {1, 4}}, true), Catch::Contains("0:4, not 1:4"));
    CHECK(begin(stamp, true) == 1);
    // The file is shorter than the journal says: the machine went down before the bytes were stored.
    fs::resize_file(folder / "out.partial", 9);
    CHECK(begin(stamp, true) == 0);
    for (const char* broken :
         {"", "\n", "nonsense\n", "[]\n", "{\"unfinished\":\"lamella\",\"version\":2}\n"}) {
        write_text(folder / "out.partial.journal", broken);
        CHECK_THROWS_AS(begin(stamp, true), InputError);
    }
    fs::remove(folder / "out.partial.journal");
    CHECK_THROWS_WITH(begin(stamp, true), Catch::Contains("journal"));
    UnfinishedFile forced(folder / "out", true);
    CHECK(forced.begin(stamp, false) == 0);
    CHECK(!forced.resumed());
}

TEST_CASE("what every layer handed over is there again, however often the run stopped", "[unfinished_file]") {
    const TemporaryFolder folder;
    for (int layer = 0; layer < 3; ++layer) {
        UnfinishedFile file(folder / "out", false);
        CHECK(file.begin(stamp, layer > 0) == layer);
        REQUIRE(file.history().size() == static_cast<std::size_t>(layer));
        for (int k = 0; k < layer; ++k) CHECK(file.history()[static_cast<std::size_t>(k)] == 10 * k);
        file.commit("layer\n", layer + 1, 10 * layer);
    }
}

TEST_CASE("journals of hostile content do not mislead", "[unfinished_file]") {
    const TemporaryFolder folder;
    const std::string head = to_json(stamp).dump() + "\n";
    write_text(folder / "out.partial", "0123456789");
    for (const char* line :
         {"{\"next\":1e300,\"size\":3}", "{\"next\":-1,\"size\":3}", "{\"next\":5,\"size\":3}",
          "{\"next\":1,\"size\":-3}", "{\"next\":1,\"size\":11}", "{\"next\":\"1\",\"size\":3}",
          "{\"next\":1}", "null"}) {
        INFO(line);
        write_text(folder / "out.partial", "0123456789");
        write_text(folder / "out.partial.journal", head + line + "\n");
        UnfinishedFile file(folder / "out", false);
        CHECK(file.begin(stamp, true) == 0);
        CHECK(!file.resumed());
        CHECK(fs::file_size(folder / "out.partial") == 0);
    }
}

}  // namespace unfinished_file_test
