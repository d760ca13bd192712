// Plans of supports on disk: read back exactly, or not at all.
#include "recipe/build/support_plan.h"

#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>
#include <limits>
#include <thread>

#include "recipe/identity.h"
#include "tests/app/commands/folder.h"

namespace support_plan_test {

using namespace lamella;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

const std::string hash = "0123456789abcdef0123456789abcdef";

/// A plan of numbers that text easily loses: thirds, tiny ones, a negative zero, neighbours of one.
SupportPlan awkward_plan() {
    const double third = 1.0 / 3, tiny = 1e-17, next = std::nextafter(1.0, 2.0);
    SupportPlan plan;
    plan.survey.hanging_length = 2.0 / 3 * 1e5;
    plan.survey.own_bridges = 12;
    plan.survey.blocked = 3;
    plan.survey.topples_at = 0.1 + 0.2;
    Scaffold& s = plan.scaffold;
    s.points = {{{third, -third, tiny}, SupportReason::overhang},
                {{-0.0, next, 1e300}, SupportReason::island},
                {{std::numeric_limits<double>::denorm_min(), 3, -17}, SupportReason::span},
                {{0.1, 0.7, 1 / 7.0}, SupportReason::stability}};
    s.unheld = {1, 3};
    s.bars = {{{-third, tiny, 5}, {third, next, 5}}};
    s.pillars = {{{-1e-17, 2.0 / 7}, -0.1, 5 * third, 3.5}, {{1, 2}, 3, 4, 0}};
    s.connectors = {{{1.1, -2.2, 3.3}, third, {4.4, 5.5, -6.6}, tiny}};
    plan.survey.points = s.points;
    return plan;
}

/// Every number of a plan as its bits, so that -0 is not 0.
std::vector<std::uint64_t> bits(const SupportPlan& plan) {
    std::vector<std::uint64_t> all;
    const auto whole = [&](std::uint64_t number) { all.push_back(number); };
    const auto real = [&](double number) { all.push_back(std::bit_cast<std::uint64_t>(number)); };
    const auto place = [&](dvec3 p) {
        for (const double number : {p.x, p.y, p.z}) real(number);
    };
    real(plan.survey.hanging_length);
    whole(plan.survey.own_bridges);
    whole(plan.survey.blocked);
    whole(plan.survey.topples_at.has_value());
    real(plan.survey.topples_at.value_or(0));
    for (const auto* points : {&plan.survey.points, &plan.scaffold.points}) {
        whole(points->size());
        for (const SupportPoint& point : *points) {
            place(point.at);
            whole(static_cast<std::uint64_t>(point.reason));
        }
    }
    for (const std::size_t index : plan.scaffold.unheld) whole(index);
    whole(plan.scaffold.bars.size());
    for (const ScaffoldBar& bar : plan.scaffold.bars) {
        place(bar.a);
        place(bar.b);
    }
    whole(plan.scaffold.pillars.size());
    for (const ScaffoldPillar& p : plan.scaffold.pillars) {
        for (const double number : {p.at.x, p.at.y, p.bottom, p.top, p.foot}) real(number);
    }
    whole(plan.scaffold.connectors.size());
    for (const Beam& beam : plan.scaffold.connectors) {
        place(beam.a);
        place(beam.b);
        real(beam.ra);
        real(beam.rb);
    }
    return all;
}

std::string file_of(const Folder& folder) { return folder / (hash + ".json"); }

/// A plan's file, to be damaged.
class KeptPlan {
  public:
    KeptPlan() {
        REQUIRE(keep_plan(folder_.path(), hash, awkward_plan()));
        text = contents(file_of(folder_));
    }

    bool reads(const std::string& damaged) const {
        write(file_of(folder_), damaged);
        return read_plan(folder_.path(), hash).has_value();
    }

    /// After a change of its contents, with a hash of them that fits: only the numbers can give it away.
    bool reads_after(const std::function<void(Json&)>& change) const {
        Json json = Json::parse(text);
        change(json["contents"]);
        Fnv128 fitting;
        fitting.add(json["contents"].dump());
        json["contents_hash"] = fitting.hex();
        return reads(json.dump());
    }

    std::string text;

  private:
    Folder folder_;
};

/// Sets a variable of the environment, or takes it away, for as long as it lives.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~Variable() { set(before_ ? before_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    void set(const char* value) { value ? setenv(name_, value, 1) : unsetenv(name_); }

    const char* name_;
    std::optional<std::string> before_;
};

}  // namespace

TEST_CASE("a plan read back is the plan that was kept, bit for bit") {
    const Folder folder;
    REQUIRE(keep_plan(folder.path(), hash, awkward_plan()));
    const auto read = read_plan(folder.path(), hash);
    REQUIRE(read.has_value());
    CHECK(bits(*read) == bits(awkward_plan()));
    CHECK(tree(folder.path()).size() == 1);
    SupportPlan steady = awkward_plan();
    steady.survey.topples_at.reset();
    steady.scaffold = Scaffold{};
    steady.survey.points.clear();
    REQUIRE(keep_plan(folder.path(), hash, steady));
    CHECK(bits(*read_plan(folder.path(), hash)) == bits(steady));
    CHECK(tree(folder.path()).size() == 1);
}

TEST_CASE("a folder is made for the first plan") {
    const Folder folder;
    const fs::path deep = folder.path() / "a/b";
    CHECK_FALSE(read_plan(deep, hash).has_value());
    CHECK_FALSE(fs::exists(deep));
    CHECK(keep_plan(deep, hash, awkward_plan()));
    CHECK(read_plan(deep, hash).has_value());
    CHECK_FALSE(read_plan(deep, "00000000000000000000000000000000").has_value());
}

TEST_CASE("a plan with any byte missing or changed is as good as none") {
    const KeptPlan kept;
    REQUIRE(kept.reads(kept.text));
    for (std::size_t length = 0; length + 2 < kept.text.size(); ++length) {
        CAPTURE(length);
        REQUIRE_FALSE(kept.reads(kept.text.substr(0, length)));
    }
    CHECK_FALSE(kept.reads(kept.text + "x"));
    CHECK_FALSE(kept.reads(""));
    CHECK_FALSE(kept.reads("[1, 2]"));
    CHECK_FALSE(kept.reads("null"));
    CHECK_FALSE(kept.reads(std::string(100000, '[')));
    CHECK_FALSE(kept.reads(std::string(1000, '\0')));
    for (std::size_t at = 0; at + 1 < kept.text.size(); ++at) {
        CAPTURE(at);
        std::string damaged = kept.text;
        damaged[at] = damaged[at] == '1' ? '2' : '1';
        REQUIRE_FALSE(kept.reads(damaged));
    }
    CHECK(kept.reads(kept.text));
}

TEST_CASE("a plan of another job, kind or version is as good as none") {
    const KeptPlan kept;
    const auto with = [&](const char* key, const Json& value) {
        Json json = Json::parse(kept.text);
        json[key] = value;
        return kept.reads(json.dump());
    };
    CHECK(with("note", "a further key does no harm"));
    CHECK_FALSE(with("plan", "lamella islands"));
    CHECK_FALSE(with("version", 2));
    CHECK_FALSE(with("version", "1"));
    CHECK_FALSE(with("hash", "0123456789abcdef0123456789abcdee"));
    CHECK_FALSE(with("contents", Json::array()));
    for (const char* key : {"plan", "version", "hash", "contents_hash", "contents"}) {
        Json json = Json::parse(kept.text);
        json.erase(key);
        CHECK_FALSE(kept.reads(json.dump()));
    }
}

TEST_CASE("numbers that make no plan are not believed, even where the hash of the contents fits") {
    const KeptPlan kept;
    REQUIRE(kept.reads_after([](Json&) {}));
    const std::vector<std::pair<const char*, const char*>> wrong{
        {"/unheld", "[4]"},
        {"/unheld", "[18446744073709551615]"},
        {"/unheld", "[-1]"},
        {"/unheld", "[1.5]"},
        {"/unheld", "[3, 1]"},
        {"/unheld", "[1, 1]"},
        {"/unheld", "[[1]]"},
        {"/points/0", "[1, 2, 3]"},
        {"/points/0", "[1, 2, 3, 0, 0]"},
        {"/points/0", "[1, 2, 3, 4]"},
        {"/points/0", "[1, 2, 3, -1]"},
        {"/points/0", "[1, 2, 3, 0.5]"},
        {"/points/0", "[1, 2, null, 0]"},
        {"/points/0", "[1, 2, \"3\", 0]"},
        {"/points/0", "[1, 2, true, 0]"},
        {"/points/0", "{\"x\": 1, \"y\": 2, \"z\": 3, \"reason\": 0}"},
        {"/points", "17"},
        {"/bars/0", "[1, 2, 3, 4, 5]"},
        {"/bars/0", "[1, 2, 3, 4, 5, 6, 7]"},
        {"/pillars/1", "[1, 2, 3, 4]"},
        {"/connectors/0", "[1, 2, 3, 4, 5, 6, 7]"},
        {"/connectors/0", "[]"},
        {"/survey/own_bridges", "-1"},
        {"/survey/own_bridges", "1.5"},
        {"/survey/left_out", "null"},
        {"/survey/hanging_length_mm", "null"},
        {"/survey/topples_at_mm", "\"never\""},
    };
    for (const auto& [place, value] : wrong) {
        CAPTURE(place, value);
        CHECK_FALSE(kept.reads_after(
            [&](Json& contents) { contents[Json::json_pointer(place)] = Json::parse(value); }));
    }
    for (const char* key : {"survey", "points", "unheld", "bars", "pillars", "connectors"}) {
        CAPTURE(key);
        CHECK_FALSE(kept.reads_after([&](Json& contents) { contents.erase(key); }));
    }
}

TEST_CASE("a plan with a number that is none is not read back") {
    const Folder folder;
    for (const double number : {std::numeric_limits<double>::quiet_NaN(), 1 / 0.0}) {
        SupportPlan plan = awkward_plan();
        plan.scaffold.connectors[0].b.y = number;
        keep_plan(folder.path(), hash, plan);
        CHECK_FALSE(read_plan(folder.path(), hash).has_value());
    }
    // What JSON cannot hold: a number beyond the largest.
    std::string text = contents(file_of(folder));
    text.replace(text.find("null"), 4, "1e999");
    write(file_of(folder), text);
    CHECK_FALSE(read_plan(folder.path(), hash).has_value());
}

TEST_CASE("a folder that cannot be written to keeps nothing and is no error") {
    const Folder folder;
    CHECK_FALSE(keep_plan({}, hash, awkward_plan()));
    CHECK_FALSE(read_plan({}, hash).has_value());
    write(folder / "file", "no folder");
    CHECK_FALSE(keep_plan(folder / "file", hash, awkward_plan()));
    CHECK_FALSE(keep_plan(folder / "file/below", hash, awkward_plan()));
    CHECK_FALSE(read_plan(folder / "file/below", hash).has_value());
    CHECK_FALSE(keep_plan("/proc/self", hash, awkward_plan()));
    CHECK(tree(folder.path()).size() == 1);
    // A folder of the plan's name is in the way: what was written for the plan goes, too.
    fs::create_directories(folder.path() / "plans" / (hash + ".json") / "taken");
    CHECK_FALSE(keep_plan(folder / "plans", hash, awkward_plan()));
    CHECK_FALSE(read_plan(folder / "plans", hash).has_value());
    CHECK(std::distance(fs::directory_iterator(folder / "plans"), {}) == 1);
}

TEST_CASE("processes and threads that keep one plan at once do each other no harm") {
    const Folder folder;
    SupportPlan plan = awkward_plan();
    for (int i = 0; i < 2000; ++i) plan.scaffold.bars.push_back({{i / 3.0, 1, 2}, {i / 7.0, 4, 5}});
    const auto expected = bits(plan);
    REQUIRE(keep_plan(folder.path(), hash, plan));
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        int failed = 0;
        for (int i = 0; i < 20; ++i) failed += !keep_plan(folder.path(), hash, plan);
        _exit(failed);
    }
    std::atomic<int> lost = 0, different = 0;
    std::vector<std::thread> threads;
    for (int k = 0; k < 3; ++k) {
        threads.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                lost += !keep_plan(folder.path(), hash, plan);
                const auto read = read_plan(folder.path(), hash);
                different += !read || bits(*read) != expected;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(lost == 0);
    CHECK(different == 0);
    CHECK(tree(folder.path()).size() == 1);
}

TEST_CASE("plans are kept in the user's cache") {
    const auto folder_with = [](const char* cache, const char* home) {
        const Variable cache_home("XDG_CACHE_HOME", cache), home_folder("HOME", home);
        return default_plan_folder();
    };
    CHECK(folder_with("/var/cache/me", "/home/me") == "/var/cache/me/lamella/plans");
    CHECK(folder_with(nullptr, "/home/me") == "/home/me/.cache/lamella/plans");
    CHECK(folder_with("", "/home/me") == "/home/me/.cache/lamella/plans");
    CHECK(folder_with("relative", "/home/me") == "/home/me/.cache/lamella/plans");
    CHECK(folder_with(nullptr, nullptr).empty());
    CHECK(folder_with("", "").empty());
}

}  // namespace support_plan_test
