// The thread between a queue of layers and a port: pauses, layers that come late, ports that vanish.
#include "printers/serial/print_link.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "printers/serial/serial_output.h"
#include "tests/printers/serial/link_job.h"

namespace print_link_test {

using namespace lamella;
using namespace lamella::test;

TEST_CASE("when no layer is ready the nozzle waits off the part, and comes back to where it was") {
    PtyMachine machine({}, 20);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 20), 0));
    REQUIRE(wait_for(20, [&] { return link.status().parked; }));
    link.submit(chunk_of(layer(1, 20), 1));
    link.finish();
    CHECK(link.status().underruns >= 1);
    const auto lines = job_lines(machine.executed());
    const auto parked = index_of(lines, "G0 X5 Y200 F6000");
    // Back over the last bead, down again, hot, with what was drawn back pushed forward.
    const std::vector<std::string> way{
        "G1 E-2 F1800",     "G0 Z6 F600", "G0 X5 Y200 F6000", "G90", "M83", "M109 S200", "G0 Z6 F600",
        "G0 X14 Y20 F6000", "G0 Z1 F600", "G1 E2 F1800",      "G90", "M83", "G1 F6000",  "G0 Z2 F600"};
    REQUIRE(parked >= 2);
    REQUIRE(lines.size() >= static_cast<std::size_t>(parked) - 2 + way.size());
    CHECK(first_difference({lines.begin() + parked - 2,
                            lines.begin() + parked - 2 + static_cast<std::ptrdiff_t>(way.size())},
                           way) == "");
}

TEST_CASE("a pause parks the nozzle and a resume brings it back, with no line lost or repeated") {
    PtyMachine machine({}, 10);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    REQUIRE(wait_for(20, [&] { return machine.executed().size() > 300; }));
    machine.with([](SimulatedMarlin& printer, double) { printer.say("//action:pause"); });
    REQUIRE(wait_for(20, [&] {
        return index_of(machine.executed(), "G0 X5 Y200 F6000") < std::ssize(machine.executed());
    }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    CHECK(wait_for(2, [&] { return link.status().paused; }));
    CHECK(machine.executed().back() == "G0 X5 Y200 F6000");
    link.resume();
    link.finish();
    std::vector<std::string> moves;
    for (const std::string& line : machine.executed()) {
        if (line.starts_with("G1 X1") && line.find(" E") != std::string::npos) moves.push_back(line);
    }
    const auto wanted = layer(0, 2000);
    CHECK(first_difference(moves, {wanted.begin() + 1, wanted.end()}) == "");
}

TEST_CASE("a port that vanishes and comes back goes on with the line the printer waits for") {
    PtyMachine machine({}, 10);
    char folder[] = "/tmp/lamella_test_XXXXXX";
    REQUIRE(mkdtemp(folder) != nullptr);
    const std::string name = std::string(folder) + "/port";
    std::filesystem::create_symlink(machine.path(), name);
    LinkSettings settings = settings_of(name);
    settings.reconnect_for = 20;
    {
        PrintLink link(settings);
        link.connect();
        link.submit(chunk_of(start, -1));
        link.submit(chunk_of(layer(0, 1500), 0));
        REQUIRE(wait_for(20, [&] { return machine.executed().size() > 300; }));
        // The next program that opens a pseudo-terminal may get this one's name.
        std::filesystem::remove(name);
        machine.unplug();
        CHECK(wait_for(5, [&] { return link.status().lost; }));
        machine.plug();
        std::filesystem::create_symlink(machine.path(), name);
        link.finish();
        auto wanted = start;
        for (const std::string& line : layer(0, 1500)) wanted.push_back(line);
        CHECK(first_difference(job_lines(machine.executed()), wanted) == "");
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("a port that does not come back ends the print with its name") {
    PtyMachine machine({}, 10);
    LinkSettings settings = settings_of(machine.path());
    settings.reconnect_for = 0.2;
    PrintLink link(settings);
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 1500), 0));
    machine.unplug();
    CHECK_THROWS_AS(link.finish(), FaultError);
}

TEST_CASE("a printer that has paused by itself is left where it is, and goes on when it says so") {
    PtyMachine machine({}, 10);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(layer(0, 1000), 0));
    REQUIRE(wait_for(20, [&] { return machine.executed().size() > 200; }));
    machine.with([](SimulatedMarlin& printer, double) { printer.say("//action:paused"); });
    REQUIRE(wait_for(5, [&] { return link.status().paused; }));
    machine.with([](SimulatedMarlin& printer, double) { printer.say("//action:resumed"); });
    link.finish();
    auto wanted = start;
    for (const std::string& line : layer(0, 1000)) wanted.push_back(line);
    CHECK(first_difference(job_lines(machine.executed()), wanted) == "");
}

TEST_CASE("what the printer waits for is told, and going on ends it") {
    FirmwareOptions options;
    options.emergency_parser = options.host_prompts = GENERATE(false, true);
    PtyMachine machine(options, 10);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    auto lines = layer(0, 20);
    lines.insert(lines.begin() + 5, "M0 NUT");
    link.submit(chunk_of(start, -1));
    link.submit(chunk_of(lines, 0));
    REQUIRE(wait_for(20, [&] { return link.status().waits.has_value(); }));
    if (options.host_prompts) {
        REQUIRE(link.status().waits->buttons.size() == 1);
        link.choose(0);
    } else {
        CHECK(link.status().waits->text == "M0 NUT");
        link.resume();
    }
    link.finish();
    CHECK(!link.status().waits);
    auto wanted = start;
    wanted.insert(wanted.end(), lines.begin(), lines.end());
    CHECK(first_difference(job_lines(machine.executed()), wanted) == "");
}

TEST_CASE("a stop ends a wait for a person, then switches off; a printer that asks to be left is left") {
    PtyMachine machine({}, 10);
    PrintLink link(settings_of(machine.path()));
    link.connect();
    link.submit(chunk_of(start, -1));
    SECTION("stop") {
        link.submit(chunk_of({"M0", "G1 X50 E1"}, 0));
        REQUIRE(wait_for(20, [&] { return link.status().waits.has_value(); }));
        link.stop();
        CHECK_THROWS_AS(link.finish(), Interrupted);
        CHECK(machine.executed().back() == "M84");
        CHECK(index_of(machine.executed(), "G1 X50 E1") == std::ssize(machine.executed()));
    }
    SECTION("disconnect") {
        machine.with([](SimulatedMarlin& printer, double) { printer.say("//action:disconnect"); });
        CHECK_THROWS_WITH(link.finish(), Catch::Contains("disconnected"));
    }
    SECTION("halt where neither the firmware nor the port can") {
        link.halt();
        CHECK_THROWS_WITH(link.finish(), Catch::Contains("switch the printer off"));
    }
}

TEST_CASE("a journal that cannot be written is told while the print goes on") {
    PtyMachine machine({}, 20);
    LinkSettings settings = settings_of(machine.path());
    settings.journal = "/dev/null/journal";
    PrintLink link(settings);
    link.connect();
    PrintChunk chunk = chunk_of(start, -1);
    chunk.resume = {{"next", 0}};
    link.submit(chunk);
    CHECK(wait_for(20, [&] { return !link.status().journal_trouble.empty(); }));
    link.finish();
}

TEST_CASE("a port belongs to one program, and closing it does not hang up") {
    PtyMachine machine({});
    MachinePort port = MachinePort::open_serial(machine.path(), 250000);
    CHECK_THROWS_AS(MachinePort::open_serial(machine.path(), 250000), InputError);
    termios mode{};
    REQUIRE(tcgetattr(port.descriptor(), &mode) == 0);
    CHECK((mode.c_cflag & HUPCL) == 0);
    CHECK((mode.c_lflag & (ICANON | ECHO)) == 0);
    port.close();
    CHECK_NOTHROW(MachinePort::open_serial(machine.path(), 115200));
}

TEST_CASE("GRBL: a pause of the job is told and ended, a stop holds before it resets") {
    PtyGrbl machine({}, 5);
    LinkSettings settings = settings_of(machine.path());
    settings.dialect = Dialect::grbl;
    PrintLink link(settings);
    link.connect();
    std::vector<std::string> lines{"M4 S0"};
    for (int i = 0; i < 400; ++i) lines.push_back(i == 50 ? "M0" : "G1X" + std::to_string(i));
    link.submit(chunk_of(lines, 0));
    REQUIRE(wait_for(20, [&] { return link.status().waits.has_value(); }));
    CHECK(machine.executed().back() == "M0");
    SECTION("goes on") {
        link.resume();
        link.finish();
        lines.emplace_back("G4 P0.01");
        CHECK(machine.executed() == lines);
    }
    SECTION("stopped") {
        link.resume();
        REQUIRE(wait_for(20, [&] { return machine.executed().size() > 100; }));
        link.stop();
        CHECK_THROWS_WITH(link.finish(), Catch::Contains("position is kept"));
        CHECK(machine.with(
            [](SimulatedGrbl& grbl, double) { return grbl.resets == 1 && grbl.reset_while_held; }));
        CHECK(machine.executed().size() < 300);
    }
    SECTION("reset by itself") {
        link.resume();
        REQUIRE(wait_for(20, [&] { return machine.executed().size() > 100; }));
        machine.with([](SimulatedGrbl& grbl, double) { grbl.boot(); });
        CHECK_THROWS_WITH(link.finish(), Catch::Contains("Grbl 1.1h"));
        // Lines that were on their way when it was noticed are still executed: a receive buffer's, 7 bytes
        // each.
        const auto at_notice = machine.executed().size();
        const auto pass_time = [] { std::this_thread::sleep_for(std::chrono::milliseconds(100)); };
        pass_time();
        REQUIRE(wait_for(
            20, [&] { return machine.with([](SimulatedGrbl& grbl, double) { return grbl.idle(); }); }));
        const auto ran = machine.executed().size();
        CHECK(ran <= at_notice + 128 / 7);
        pass_time();
        CHECK(machine.executed().size() == ran);
    }
}

TEST_CASE("only a path to a serial line is one, and none is opened to find out") {
    PtyMachine machine({});
    CHECK(is_serial_line(machine.path()));
    char folder[] = "/tmp/lamella_test_XXXXXX";
    REQUIRE(mkdtemp(folder) != nullptr);
    const std::string link = std::string(folder) + "/port";
    std::filesystem::create_symlink(machine.path(), link);
    CHECK(is_serial_line(link));
    for (const char* path :
         {"/dev/null", "/dev/tty", "/dev/ptmx", "/dev", "/etc/passwd", "/dev/no-such-port", ""}) {
        INFO(path);
        CHECK(!is_serial_line(path));
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("a link that is too slow for a job is told beforehand") {
    CHECK(link_warning({500, 14000}, 250000).empty());
    CHECK(link_warning({500, 14000}, 115200).find("14000 bytes/s") != std::string::npos);
}

TEST_CASE("the densest stretch of a job tells what the link has to carry") {
    ChunkMaker maker(Dialect::marlin);
    std::string text = "G28\nG90\nM83\nG1 X0 Y0 F6000\n";
    for (int i = 1; i <= 100; ++i) text += "G1 X" + std::to_string(i) + " E1\n";           // 10 ms each
    for (int i = 1; i <= 10; ++i) text += "G1 X" + std::to_string(i % 2 * 100) + " E1\n";  // 1 s each
    maker.clean(text);
    CHECK(maker.lines() == 114);
    CHECK(maker.seconds() == Approx(1 + 0 + 9).margin(0.05));
    CHECK(maker.need().lines == Approx(104).margin(2));
}

}  // namespace print_link_test
