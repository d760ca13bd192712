// Runs that are killed at any moment, or meet a full disk, are continued to the same bytes in every format.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <random>

#include "tests/app/commands/command_run.h"

namespace killed_runs_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

/// A ball of foam with supports: every layer takes some milliseconds.
const std::string part =
    "slice --shape sphere --shape-radius 4 --cell 2 --beam 0.3 --skin 0.4 --layer-height 0.1 --support "
    "bridges "
    "--quiet --printer-width 800 --printer-height 600 --printer-pixel 0.025 --no-printer-preview ";

struct Format {
    const char* ending;  ///< of the output's name, which chooses the back-end
    const char* settings;
};

const Format formats[] = {
    {"/", ""},        {".sl1", ""}, {".goo", ""}, {".svg", ""}, {".gcode", "--printer marlin "},
    {".nanodlp", ""}, {".cli", ""}, {".3mf", ""}};

/// All bytes of a file, or of a folder's files with their names.
std::string everything(const std::string& path) {
    if (!fs::is_directory(path)) return contents(path);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    std::string all;
    for (const std::string& name : names) all += name + "\n" + contents((fs::path(path) / name).string());
    return all;
}

/// Starts `lamella` and kills it after a time, unless it has ended by then.
void killed_run(const std::string& arguments, const std::string& cache, std::chrono::microseconds after) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const std::string line = "exec env " + command_line(arguments, cache) + " >/dev/null 2>&1 </dev/null";
        execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        _exit(127);
    }
    std::this_thread::sleep_for(after);
    kill(child, SIGKILL);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
}

std::chrono::microseconds time_of(const std::string& arguments) {
    const auto start = std::chrono::steady_clock::now();
    REQUIRE(run_lamella(arguments).code == 0);
    return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
}

}  // namespace

TEST_CASE("a run killed at twenty random moments is continued to the same bytes", "[slow]") {
    const Format format = GENERATE(from_range(std::begin(formats), std::end(formats)));
    const Folder folder;
    const std::string whole = folder / "whole" + format.ending, stopped = folder / "stopped" + format.ending;
    const std::string partial =
        folder / "stopped" + (format.ending == std::string("/") ? "" : format.ending) + ".partial";
    auto time = time_of(part + format.settings + "-o " + whole);
    const std::string bytes = everything(whole);
    std::mt19937 random(7);
    int continued = 0;
    // More than twenty where a machine that changes its speed lets too many moments fall outside the layers.
    for (int k = 0; k < 20 || (continued < 5 && k < 100); ++k) {
        // At moments spread over the whole run: one in each twentieth of it.
        const double share = (k % 20 + std::uniform_real_distribution<>(0, 1)(random)) / 20;
        killed_run(part + format.settings + "-o " + stopped, folder / "cache",
                   std::chrono::microseconds(static_cast<long>(static_cast<double>(time.count()) * share)));
        INFO(format.ending << ", killed after " << share << " of the run");
        if (!fs::exists(stopped)) {
            if (fs::exists(partial)) {
                ++continued;
            } else {
                time = time * 10 / 9;  // not even begun: it has more to do
            }
            REQUIRE(run_lamella(part + format.settings + "--resume -o " + stopped).code == 0);
        } else {
            time = time * 9 / 10;  // the machine has less to do than when it was timed
        }
        REQUIRE(everything(stopped) == bytes);
        CHECK(!fs::exists(partial));
        fs::remove_all(stopped);
        fs::remove_all(partial);
    }
    CHECK(continued >= 5);
}

TEST_CASE("a full disk is told, and a run with more room goes on") {
    const Format format = GENERATE(from_range(std::begin(formats) + 1, std::end(formats)));
    const Folder folder;
    const std::string whole = folder / "whole" + format.ending, stopped = folder / "stopped" + format.ending;
    REQUIRE(run_lamella(part + format.settings + "-o " + whole).code == 0);
    const auto size = fs::file_size(whole);
    rlimit old{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &old) == 0);
    const rlimit less{size / 2, old.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &less) == 0);
    const Outcome full = run_lamella(part + format.settings + "-o " + stopped);
    REQUIRE(setrlimit(RLIMIT_FSIZE, &old) == 0);
    CHECK(full.code == 3);
    CHECK(mentions(full.err, stopped));
    CHECK(!fs::exists(stopped));
    REQUIRE(run_lamella(part + format.settings + "--resume -o " + stopped).code == 0);
    CHECK(everything(stopped) == everything(whole));
}

TEST_CASE("several outputs of one run are those of several runs, continued too") {
    const Folder folder;
    const std::string each[] = {"a.sl1", "a.goo", "a.svg", "a.gcode@marlin"};
    std::string all;
    for (const std::string& output : each) {
        REQUIRE(run_lamella(part + "-o " + folder / output).code == 0);
        fs::create_directories(folder / "together");
        all += " -o " + folder / ("together/" + output);
    }
    const Outcome interrupted =
        interrupt_lamella(part + all, [&] { return fs::exists(folder / "together/a.svg.partial"); });
    CHECK(interrupted.code == 130);
    REQUIRE(run_lamella(part + "--resume" + all).code == 0);
    for (const std::string& output : each) {
        const std::string name = output.substr(0, output.find('@'));
        CHECK(everything(folder / ("together/" + name)) == everything(folder / name));
    }
    CHECK(run_lamella(part + "--force -o " + folder / "a.sl1" + " -o " + folder / "./a.sl1").code == 2);
    const Outcome unknown = run_lamella(part + "-o " + folder / "b.sl1@prusa-sl2");
    CHECK(unknown.code == 2);
    CHECK(mentions(unknown.err, "did you mean `prusa-sl1`"));
}

}  // namespace killed_runs_test
