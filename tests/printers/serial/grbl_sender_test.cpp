// The GRBL sender against a machine that counts the bytes it has room for.
#include "printers/serial/grbl_sender.h"

#include <catch2/catch.hpp>

#include "tests/printers/serial/simulated_grbl.h"

namespace grbl_sender_test {

using namespace lamella;
using namespace lamella::test;

namespace {

struct Bench {
    Bench() : sender({}, {}) {
        machine.boot();
        sender.connect(0);
    }
    template <class Until>
    bool run(double seconds, Until until) {
        for (const double end = now + seconds; now < end; now += 0.002) {
            sender.tick(now);
            machine.receive(sender.output());
            sender.wrote(sender.output().size());
            std::string said = machine.run(now);
            if (lose_answers > 0 && said == "ok\r\n") --lose_answers, said.clear();
            sender.receive(said, now);
            if (until()) return true;
        }
        return false;
    }
    GrblSender sender;
    SimulatedGrbl machine{{}};
    double now = 0;
    int lose_answers = 0;
};

}  // namespace

TEST_CASE("GRBL's buffer is kept full and never overflows") {
    Bench bench;
    std::vector<std::string> lines;
    for (int i = 0; i < 2000; ++i) lines.push_back("G1X" + std::to_string(i) + "S" + std::to_string(i % 255));
    lines.insert(lines.begin() + 1000, "$30=255");
    for (const auto& line : lines) bench.sender.push(line);
    bench.sender.finish();
    REQUIRE(bench.run(60, [&] { return bench.sender.finished(); }));
    lines.emplace_back("G4 P0.01");
    CHECK(bench.machine.executed() == lines);
    CHECK(!bench.machine.overflowed);
    CHECK(bench.machine.settings_alone);
    CHECK(bench.machine.fullest <= 127);
    CHECK(bench.machine.fullest > 100);
    CHECK(bench.sender.answered() == 2001);
}

TEST_CASE("a line that GRBL refuses stops the job, and is named") {
    Bench bench;
    for (int i = 0; i < 500; ++i) bench.sender.push(i == 300 ? "G99" : "G1X" + std::to_string(i));
    REQUIRE(bench.run(60, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->why.find("line 301 of the job (\"G99\"): error 20") != std::string::npos);
    bench.run(1, [] { return false; });
    CHECK(bench.machine.held());
    // Held before it runs what waits behind the line: without the hold those would be some twenty.
    CHECK(bench.machine.executed().size() <= 301);
}

TEST_CASE("an alarm, a reset and a lost answer stop the job") {
    Bench bench;
    for (int i = 0; i < 500; ++i) bench.sender.push("G1X" + std::to_string(i));
    SECTION("alarm") {
        bench.machine.alarm_at = "G1X200";
        REQUIRE(bench.run(60, [&] { return bench.sender.stopped().has_value(); }));
        CHECK(bench.sender.stopped()->why.find("alarm 2") != std::string::npos);
    }
    SECTION("reset") {
        REQUIRE(bench.run(60, [&] { return bench.machine.executed().size() == 100; }));
        bench.machine.receive("\x18");
        REQUIRE(bench.run(5, [&] { return bench.sender.stopped().has_value(); }));
        CHECK(bench.sender.stopped()->kind == StopKind::reset);
    }
    SECTION("lost answers") {
        REQUIRE(bench.run(60, [&] { return bench.machine.executed().size() == 100; }));
        bench.lose_answers = 1000;
        REQUIRE(bench.run(20, [&] { return bench.sender.stopped().has_value(); }));
        CHECK(bench.sender.stopped()->kind == StopKind::lost_count);
    }
    const auto ran = bench.machine.executed().size();
    bench.run(1, [] { return false; });
    CHECK(bench.machine.executed().size() <= ran + 1);
}

TEST_CASE("GRBL is reset only once it stands still") {
    Bench bench;
    for (int i = 0; i < 500; ++i) bench.sender.push("G1X" + std::to_string(i));
    REQUIRE(bench.run(60, [&] { return bench.machine.executed().size() == 100; }));
    bench.sender.halt(bench.now);
    bench.run(1, [] { return false; });
    CHECK(bench.machine.resets == 1);
    CHECK(bench.machine.reset_while_held);
    CHECK(bench.machine.executed().size() <= 101);
}

TEST_CASE("a pause holds GRBL's motion, and nothing is lost") {
    Bench bench;
    for (int i = 0; i < 200; ++i) bench.sender.push("G1X" + std::to_string(i));
    bench.sender.finish();
    REQUIRE(bench.run(60, [&] { return bench.machine.executed().size() == 100; }));
    bench.sender.hold_motion(true);
    bench.run(5, [] { return false; });
    CHECK(bench.machine.executed().size() <= 101);
    CHECK(!bench.sender.stopped());
    bench.sender.hold_motion(false);
    REQUIRE(bench.run(60, [&] { return bench.sender.finished(); }));
    CHECK(bench.machine.executed().size() == 201);
}

TEST_CASE("GRBL's M0 is a wait for a person, told and ended, and no other hold is") {
    Bench bench;
    for (int i = 0; i < 200; ++i) bench.sender.push(i == 100 ? "M0" : "G1X" + std::to_string(i));
    bench.sender.finish();
    REQUIRE(bench.run(60, [&] { return bench.machine.executed().size() == 50; }));
    bench.sender.hold_motion(true);
    bench.run(1, [] { return false; });
    CHECK(!bench.sender.user_wait());
    bench.sender.hold_motion(false);
    REQUIRE(bench.run(60, [&] { return bench.sender.user_wait().has_value(); }));
    CHECK(bench.sender.user_wait()->text.find("M0") != std::string::npos);
    bench.run(1000, [] { return false; });
    CHECK(!bench.sender.stopped());
    CHECK(bench.machine.executed().back() == "M0");
    bench.sender.end_waiting();
    REQUIRE(bench.run(60, [&] { return bench.sender.finished(); }));
    CHECK(!bench.sender.user_wait());
    CHECK(bench.sender.answered() == 200);
}

TEST_CASE("a GRBL that was on before tells its name and buffer, and is streamed to") {
    Bench bench;
    bench.machine.run(0);  // its greeting is lost
    bench.sender.push("G1X1");
    REQUIRE(bench.run(60, [&] { return bench.sender.connected(); }));
    CHECK(bench.sender.firmware() == "Grbl 1.1h");
    CHECK(bench.sender.bytes_ahead() == 127);
}

TEST_CASE("while its port is away nothing is sent to GRBL, not even a request for its state") {
    Bench bench;
    for (int i = 0; i < 500; ++i) bench.sender.push("G1X" + std::to_string(i));
    REQUIRE(bench.run(60, [&] { return bench.machine.executed().size() == 100; }));
    bench.sender.disconnect();
    const auto before = bench.sender.statistics().bytes;
    for (double t = 0; t < 100; t += 0.1) bench.sender.tick(bench.now + t);
    bench.sender.hold_motion(true);
    bench.sender.end_waiting();
    CHECK(bench.sender.output().empty());
    CHECK(bench.sender.statistics().bytes == before);
    CHECK(!bench.sender.stopped());
    bench.sender.reconnect(bench.now + 100);
    REQUIRE(bench.sender.stopped());
    CHECK(bench.sender.stopped()->why.find("without line numbers") != std::string::npos);
}

TEST_CASE("a Marlin that is taken for GRBL is told apart") {
    GrblSender sender({}, {});
    sender.connect(0);
    sender.receive("start\nMarlin 2.1.2.1\n", 0.5);
    REQUIRE(sender.stopped());
    CHECK(sender.stopped()->why.find("--firmware marlin") != std::string::npos);
}

}  // namespace grbl_sender_test
