// Single mishaps on the way to a Marlin, each by itself.
#include <catch2/catch.hpp>

#include "tests/printers/serial/marlin_bench.h"

namespace marlin_trouble_test {

using namespace lamella;
using namespace lamella::test;

namespace {

/// A bench in the middle of a job of 400 moves.
MarlinBench& in_mid_job(MarlinBench& bench) {
    for (const std::string& line : moves(400, 0.01)) bench.sender.push(line);
    bench.sender.finish();
    REQUIRE(bench.run(30, [&] { return job_lines(bench.printer.executed()).size() >= 200; }));
    return bench;
}

}  // namespace

TEST_CASE("a lost ok costs less than five seconds, with all lines executed once") {
    FirmwareOptions options;
    options.old = GENERATE(false, true);
    MarlinBench bench(options);
    in_mid_job(bench);
    const double before = bench.now;
    bench.in.lose_next("ok");
    REQUIRE(bench.run(20, [&] { return bench.sender.finished(); }));
    CHECK(bench.now - before < 200 * 0.01 + 5);
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(400, 0.01)) == "");
}

TEST_CASE("a board that resets in mid job is sent nothing any more") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.printer.boot(bench.now);
    REQUIRE(bench.run(5, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::reset);
    const auto ran = bench.printer.executed().size();
    bench.run(5, [] { return false; });
    CHECK(bench.printer.executed().size() == ran);
}

TEST_CASE("a board that resets without a word is found out, and the job is not begun anew on it") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.printer.boot(bench.now);
    bench.in.take(bench.now + 100);
    bench.printer.run(bench.now);
    REQUIRE(bench.run(30, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::lost_count);
    const auto lines = job_lines(bench.printer.executed());
    CHECK(std::count(lines.begin(), lines.end(), moves(400, 0.01).front()) == 1);
}

TEST_CASE("a printer that gives up ends the job with its own words") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.printer.say("Error:Thermal Runaway, system stopped! Heater_ID: 0");
    REQUIRE(bench.run(5, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::fatal);
    CHECK(bench.sender.stopped()->why.find("Thermal Runaway") != std::string::npos);
}

TEST_CASE("a line that is unplugged for a while goes on where the printer stands") {
    FirmwareOptions options;
    options.old = GENERATE(false, true);
    MarlinBench bench(options);
    in_mid_job(bench);
    bench.unplugged = true;
    bench.run(2, [] { return false; });
    bench.unplugged = false;
    bench.sender.reconnect(bench.now);
    REQUIRE(bench.run(60, [&] { return bench.sender.finished() || bench.sender.stopped(); }));
    CHECK(!bench.sender.stopped());
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(400, 0.01)) == "");
}

TEST_CASE("a line that was unplugged together with the board is not gone on with") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.unplugged = true;
    bench.run(1, [] { return false; });
    bench.unplugged = false;
    bench.sender.reconnect(bench.now);
    bench.printer.boot(bench.now);
    REQUIRE(bench.run(60, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::reset);
}

TEST_CASE("a printer that says nothing any more is given up") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.unplugged = true;
    REQUIRE(bench.run(1000, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::unanswered);
}

TEST_CASE("firmware that leaves out the ok of a resend is understood") {
    FirmwareOptions options;
    options.resend_has_ok = false;
    options.spurious = 0.02;
    MarlinBench bench(options);
    REQUIRE(bench.print(moves(1000), 400));
    CHECK(!bench.sender.stopped());
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(1000)) == "");
}

TEST_CASE("a line that can never be read is told, not sent for ever") {
    FirmwareOptions options;
    options.spurious = 1;
    MarlinBench bench(options);
    REQUIRE(bench.print(moves(10), 100));
    REQUIRE(bench.sender.stopped());
    CHECK(bench.sender.stopped()->kind == StopKind::lost_count);
    CHECK(bench.sender.stopped()->why.find("line 1 (M115)") != std::string::npos);
    CHECK(bench.printer.errors() < 50);
}

TEST_CASE("slow commands are waited for, and a heating printer is not asked for its temperature") {
    MarlinBench bench({});
    const std::vector<std::string> lines{"M140 S60", "G28", "M109 S210", "G4 S20", "G1 X10 F6000"};
    REQUIRE(bench.print(lines, 100));
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK(bench.sender.statistics().timeouts == 0);
    CHECK(bench.sender.temperatures().nozzle_target == 210);
}

TEST_CASE("an emergency stop works past a full buffer where the firmware looks for it") {
    FirmwareOptions options;
    options.emergency_parser = true;
    MarlinBench bench(options);
    for (const std::string& line : moves(400, 2)) bench.sender.push(line);
    REQUIRE(bench.run(60, [&] { return job_lines(bench.printer.executed()).size() >= 18; }));
    REQUIRE(bench.sender.halts_at_once());
    const double before = bench.now;
    bench.sender.halt(bench.now);
    REQUIRE(bench.run(1, [&] { return bench.printer.killed(); }));
    CHECK(bench.now - before < 0.1);
    CHECK(!bench.printer.heating());
}

TEST_CASE("held, no line of the job is sent, but the host's own are") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.sender.hold(true);
    REQUIRE(bench.run(20, [&] { return bench.sender.quiet(); }));
    const auto ran = job_lines(bench.printer.executed()).size();
    bench.sender.interject("M117 waiting");
    bench.run(3, [] { return false; });
    const auto then = job_lines(bench.printer.executed());
    CHECK(then.size() == ran + 1);
    CHECK(then.back() == "M117 waiting");
    bench.sender.hold(false);
    REQUIRE(bench.run(20, [&] { return bench.sender.finished(); }));
    CHECK(bench.sender.answered() == 400);
}

TEST_CASE("while the port is away nothing is sent, counted or timed, however long it takes") {
    FirmwareOptions options;
    options.old = GENERATE(false, true);
    options.advanced_ok = GENERATE(false, true);
    MarlinBench bench(options);
    in_mid_job(bench);
    // Firmware that has once been busy is given 3 s to answer: five times that is less than a minute.
    bench.printer.say("echo:busy: processing");
    bench.run(0.1, [] { return false; });
    bench.unplugged = true;
    bench.sender.disconnect();
    const SenderStatistics before = bench.sender.statistics();
    CHECK(!bench.run(59, [&] { return !bench.sender.output().empty() || bench.sender.stopped(); }));
    CHECK(bench.sender.wake_at() == LineSender::never);
    // Not even what a person asks for.
    bench.sender.end_waiting();
    bench.sender.hold_motion(true);
    CHECK(bench.sender.output().empty());
    CHECK(bench.sender.statistics().lines == before.lines);
    CHECK(bench.sender.statistics().bytes == before.bytes);
    CHECK(bench.sender.statistics().timeouts == 0);
    bench.unplugged = false;
    bench.sender.reconnect(bench.now);
    REQUIRE(bench.run(60, [&] { return bench.sender.finished() || bench.sender.stopped(); }));
    CHECK(!bench.sender.stopped());
    CHECK(bench.sender.statistics().timeouts == 0);
    CHECK(bench.sender.statistics().longest_gap < 60);
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(400, 0.01)) == "");
}

TEST_CASE("a port that is lost again before the printer answers does not begin the numbers anew") {
    FirmwareOptions options;
    options.old = GENERATE(false, true);
    MarlinBench bench(options);
    in_mid_job(bench);
    for (int loss = 0; loss < 4; ++loss) {
        bench.unplugged = true;
        bench.sender.disconnect();
        bench.run(2, [] { return false; });
        bench.unplugged = false;
        bench.sender.reconnect(bench.now);
        bench.run(1, [] { return false; });
    }
    REQUIRE(bench.run(60, [&] { return bench.sender.finished() || bench.sender.stopped(); }));
    CHECK(!bench.sender.stopped());
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(400, 0.01)) == "");
    const auto& executed = bench.printer.executed();
    CHECK(std::count(executed.begin(), executed.end(), "M115") == 1);
}

TEST_CASE("a printer that is silent behind a port that came back is given up, counted from then on") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.unplugged = true;
    bench.sender.disconnect();
    bench.run(100, [] { return false; });
    bench.sender.reconnect(bench.now);
    const double before = bench.now;
    REQUIRE(bench.run(1000, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::unanswered);
    CHECK(bench.now - before > 15);
}

TEST_CASE("why the printer halted is told, not only that it did") {
    MarlinBench bench({});
    in_mid_job(bench);
    SECTION("an error") { bench.printer.say("Error:Homing Failed"); }
    SECTION("an echo") { bench.printer.say("echo:Homing Failed"); }
    SECTION("with a report in between") {
        bench.printer.say("Homing Failed\nX:0.00 Y:0.00 Z:0.00 Count X:0");
    }
    bench.printer.say("Error:Printer halted. kill() called!");
    REQUIRE(bench.run(5, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->why.find("Homing Failed") != std::string::npos);
    CHECK(bench.sender.stopped()->why.find("kill() called!") != std::string::npos);
}

TEST_CASE("what the printer said long before it halted is not taken for the reason") {
    MarlinBench bench({});
    in_mid_job(bench);
    bench.sender.hold(true);
    bench.printer.say("echo:SD card ok");
    bench.run(10, [] { return false; });
    bench.printer.say("Error:Printer halted. kill() called!");
    REQUIRE(bench.run(5, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->why == "the printer has stopped: Error:Printer halted. kill() called!");
}

TEST_CASE("an empty planner counts as starved while the job moves, not while it heats or homes") {
    FirmwareOptions options;
    options.advanced_ok = true;
    MarlinBench bench(options);
    std::vector<std::string> lines{"M140 S60", "M104 S100", "G28", "M109 S200"};
    for (int i = 0; i < 50; ++i) lines.push_back("M106 S" + std::to_string(i));
    for (const std::string& line : lines) bench.sender.push(line);
    REQUIRE(bench.run(60, [&] { return bench.sender.answered() == std::ssize(lines); }));
    CHECK(bench.sender.statistics().advanced == 0);
    CHECK(bench.sender.statistics().starved == 0);
    for (const std::string& line : moves(300, 0.05)) bench.sender.push(line);
    bench.sender.finish();
    REQUIRE(bench.run(60, [&] { return bench.sender.finished(); }));
    CHECK(bench.sender.statistics().advanced > 250);
    CHECK(bench.sender.statistics().advanced <= 300);
    // Moves that take longer than a line keep it full but for the first ones.
    CHECK(bench.sender.statistics().starved <= 16);
}

}  // namespace marlin_trouble_test
