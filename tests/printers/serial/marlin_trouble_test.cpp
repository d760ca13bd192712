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

}  // namespace marlin_trouble_test
