// A print over a port that is lost, stopped in a pause, paused too late, logged on a full disk.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "tests/app/commands/folder.h"
#include "tests/printers/serial/link_job.h"

namespace print_link_trouble_test {

using namespace lamella;
using namespace lamella::test;

namespace {

enum class When { at_once, parked, on_the_way };

std::ptrdiff_t count_of(const std::vector<std::string>& lines, const std::string& line) {
    return std::count(lines.begin(), lines.end(), line);
}

std::string text_of(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("a port that is away longer than a busy printer's patience leaves no timeout, only its trace") {
    PtyMachine machine({}, 10);
    const Folder folder;
    const std::string name = folder / "port";
    std::filesystem::create_symlink(machine.path(), name);
    LinkSettings settings = settings_of(name);
    settings.reconnect_for = 30;
    settings.log = folder / "log";
    auto wanted = start;
    for (const std::string& line : layer(0, 1500)) wanted.push_back(line);
    LinkStatus status;
    {
        PrintLink link(settings);
        link.connect();
        link.submit(chunk_of(start, -1));
        link.submit(chunk_of(layer(0, 1500), 0));
        REQUIRE(wait_for(20, [&] { return machine.executed().size() > 300; }));
        machine.with([](SimulatedMarlin& printer, double) { printer.say("echo:busy: processing"); });
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        // The next program that opens a pseudo-terminal may get this one's name.
        std::filesystem::remove(name);
        machine.unplug();
        REQUIRE(wait_for(5, [&] { return link.status().lost; }));
        // A busy printer is given 3 s to answer.
        std::this_thread::sleep_for(std::chrono::milliseconds(3500));
        CHECK(link.status().lost);
        machine.plug();
        std::filesystem::create_symlink(machine.path(), name);
        link.finish();
        status = link.status();
    }
    CHECK(first_difference(job_lines(machine.executed()), wanted) == "");
    CHECK(status.statistics.timeouts == 0);
    CHECK(status.losses == 1);
    CHECK(status.lost_seconds > 3);
    CHECK(status.lost_seconds < 10);
    CHECK(!status.lost);
    CHECK(status.underruns == 0);
    const std::string log = text_of(settings.log);
    const auto lost = log.find("# "), back = log.find("open again");
    REQUIRE(lost != std::string::npos);
    REQUIRE(back != std::string::npos);
    CHECK(log.substr(lost, back - lost).find('>') == std::string::npos);
}

TEST_CASE("a port that opens but is lost again and again ends the print when its time is over") {
    PtyMachine machine({}, 10);
    const Folder folder;
    const std::string name = folder / "port";
    std::filesystem::create_symlink(machine.path(), name);
    LinkSettings settings = settings_of(name);
    settings.reconnect_for = 2;
    PrintLink link(settings);
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 1500), 0));
    REQUIRE(wait_for(20, [&] { return machine.executed().size() > 300; }));
    machine.stand_still(true);
    const auto begun = std::chrono::steady_clock::now();
    std::atomic<bool> ended{false};
    std::thread flapping([&] {
        while (!ended) {
            machine.unplug();
            std::error_code absent;
            std::filesystem::remove(name, absent);
            machine.plug();
            std::filesystem::create_symlink(machine.path(), name);
            std::this_thread::sleep_for(std::chrono::milliseconds(700));
        }
    });
    CHECK_THROWS_WITH(link.finish(), Catch::Contains("did not come back within 2 s"));
    ended = true;
    flapping.join();
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(15));
}

TEST_CASE("a stop in a pause, or on the way out of one, draws back and lifts once, and waits for no heat") {
    PtyMachine machine({}, 10);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    REQUIRE(wait_for(20, [&] { return machine.executed().size() > 300; }));
    link.pause();
    const When when = GENERATE(When::at_once, When::parked, When::on_the_way);
    if (when != When::at_once)
        REQUIRE(wait_for(20, [&] { return count_of(machine.executed(), "G0 X5 Y200 F6000") > 0; }));
    if (when == When::on_the_way) {
        // The nozzle has cooled down, and the way back waits minutes for its heat.
        machine.with([](SimulatedMarlin& printer, double) { printer.cool_down(0.5); });
        link.resume();
        REQUIRE(wait_for(20, [&] { return count_of(machine.executed(), "M109 S200") == 2; }));
    }
    const double before = machine.time();
    link.stop();
    CHECK_THROWS_AS(link.finish(), Interrupted);
    CHECK(machine.time() - before < 30);
    const auto lines = machine.executed();
    CHECK(lines.back() == "M84");
    CHECK(count_of(lines, "G1 E-2 F1800") == 1);
    CHECK(count_of(lines, "G0 Z6 F600") == 1);
    CHECK(count_of(lines, "G0 Z11 F600") == 0);
    CHECK(count_of(lines, "M104 S0") == 1);
}

TEST_CASE("a stop during the first heat-up does not wait for it") {
    FirmwareOptions options;
    options.heating_rate = 0.5;  // degrees a second: minutes
    PtyMachine machine(options, 10);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    link.submit(chunk_of(start, -1));
    REQUIRE(wait_for(20, [&] { return count_of(machine.executed(), "M109 S200") == 1; }));
    REQUIRE(wait_for(20, [&] { return link.status().line_wait == LineWait::heat; }));
    const double before = machine.time();
    link.stop();
    CHECK_THROWS_AS(link.finish(), Interrupted);
    CHECK(machine.time() - before < 40);
    CHECK(machine.executed().back() == "M84");
}

TEST_CASE("a pause that comes too late is told, and the print ends as it should") {
    PtyMachine machine({}, 4);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    // Sixteen moves of a second each wait in the printer when all lines are sent.
    std::vector<std::string> slow{"G28", "G90"};
    for (int i = 0; i < 18; ++i) slow.push_back("G1 X" + std::to_string(i % 2 * 100) + " F6000");
    link.submit(chunk_of(slow, 0));
    std::thread finishing([&] { link.finish(); });
    const bool sent = wait_for(20, [&] { return link.status().statistics.lines > std::ssize(slow) + 4; });
    link.pause();
    const bool told = wait_for(20, [&] { return link.status().notices == 1; });
    CHECK(!link.status().paused);
    finishing.join();
    CHECK(sent);
    CHECK(told);
    CHECK(link.status().notice.find("too late to pause") != std::string::npos);
    CHECK(job_lines(machine.executed()) == slow);
}

TEST_CASE("the log is on the disk while the print waits") {
    PtyMachine machine({}, 10);
    const Folder folder;
    LinkSettings settings = settings_of(machine.path());
    settings.log = folder / "log";
    PrintLink link(settings);
    link.connect();
    link.submit(chunk_of({"G28", "M0 NUT"}, 0));
    REQUIRE(wait_for(20, [&] { return link.status().waits.has_value(); }));
    CHECK(wait_for(5, [&] { return text_of(settings.log).find("M0 NUT*") != std::string::npos; }));
    link.resume();
    link.finish();
    CHECK(link.status().log_trouble.empty());
    CHECK(text_of(settings.log).find("M400") != std::string::npos);
}

TEST_CASE("a log on a full disk is told while the print goes on") {
    PtyMachine machine({}, 20);
    LinkSettings settings = settings_of(machine.path());
    settings.log = "/dev/full";
    PrintLink link(settings);
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 20), 0));
    CHECK(wait_for(20, [&] { return !link.status().log_trouble.empty(); }));
    link.finish();
    CHECK(link.status().log_trouble.find("No space left on device") != std::string::npos);
    CHECK_THROWS_AS(LineLog("/nowhere/log"), InputError);
}

TEST_CASE("time left is of motion: heating adds nothing to what was printed") {
    FirmwareOptions options;
    options.heating_rate = 5;
    PtyMachine machine(options, 10);
    PrintLink link(settings_of(machine.path()));
    link.expect({2, 0, {}, {}, false});
    link.connect();
    ChunkMaker maker(Dialect::marlin);
    const auto submit = [&](const std::vector<std::string>& lines, int index) {
        PrintChunk chunk = chunk_of(lines, index);
        chunk.facts = maker.clean(chunk.lines).facts;
        link.submit(std::move(chunk));
    };
    submit(start, -1);
    submit(layer(0, 100), 0);
    REQUIRE(wait_for(20, [&] { return link.status().line_wait == LineWait::heat; }));
    const PrintProgress heating = link.status().progress;
    REQUIRE(heating.left());
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    CHECK(*link.status().progress.left() == Approx(*heating.left()).epsilon(0.01));
    CHECK(link.status().progress.layers_known == 1);
    submit(layer(1, 100), 1);
    link.finish();
    const PrintProgress ended = link.status().progress;
    CHECK(ended.layers_known == 2);
    CHECK(ended.done_seconds == Approx(ended.known_seconds));
    CHECK(*ended.share() == Approx(1));
    CHECK(*ended.left() == Approx(0).margin(1e-6));
    // 35 s of heating took 3.5 s here; 2 x 100 moves that the machine does at ten times the speed did not.
    CHECK(ended.printing < 3);
}

}  // namespace print_link_trouble_test
