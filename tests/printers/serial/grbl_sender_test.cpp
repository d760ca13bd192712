// The GRBL sender against a machine that counts the bytes it has room for.
#include "printers/serial/grbl_sender.h"

#include <catch2/catch.hpp>

using namespace lamella;

namespace {

/// GRBL 1.1 with 128 bytes of receive buffer; a line leaves it when it is run.
struct Grbl {
    void receive(std::string_view bytes) {
        for (const char c : bytes) {
            if (c == '?') {
                said += held           ? "<Hold:0|MPos:0,0,0>\r\n"
                        : ring.empty() ? "<Idle|MPos:0,0,0>\r\n"
                                       : "<Run|MPos:0,0,0>\r\n";
            } else if (c == '!') {
                held = true;
            } else if (c == '~') {
                held = false;
            } else if (c == 0x18) {
                ring.clear();
                reset_while_held = held;
                ++resets;
                said += "\r\nGrbl 1.1h ['$' for help]\r\n";
            } else {
                REQUIRE(ring.size() < 128);
                ring += c;
                fullest = std::max(fullest, ring.size());
            }
        }
    }
    void run_line() {
        const auto end = ring.find('\n');
        if (end == std::string::npos || held) return;
        const std::string line = ring.substr(0, end);
        ring.erase(0, end + 1);
        if (line[0] == '$' && !ring.empty()) alone = false;
        if (line == "$I") {
            said += "[VER:1.1h.20190830:]\r\n[OPT:V,15,128]\r\nok\r\n";
        } else if (line == alarm_at) {
            said += "ALARM:2\r\nok\r\n";
        } else if (line == "G99") {
            said += "error:20\r\n";
        } else {
            executed.push_back(line);
            said += "ok\r\n";
        }
    }
    std::string ring, said, alarm_at;
    std::vector<std::string> executed;
    std::size_t fullest = 0;
    bool held = false, alone = true, reset_while_held = false;
    int resets = 0;
};

struct Bench {
    Bench() : sender({}, {}) {
        machine.said = "\r\nGrbl 1.1h ['$' for help]\r\n";
        sender.connect(0);
    }
    template <class Until>
    bool run(double seconds, Until until) {
        for (const double end = now + seconds; now < end; now += 0.002) {
            sender.tick(now);
            machine.receive(sender.output());
            sender.wrote(sender.output().size());
            machine.run_line();
            std::string said;
            said.swap(machine.said);
            if (lose_answers > 0 && said == "ok\r\n") --lose_answers, said.clear();
            sender.receive(said, now);
            if (until()) return true;
        }
        return false;
    }
    GrblSender sender;
    Grbl machine;
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
    CHECK(bench.machine.executed.back() == "G4 P0.01");
    bench.machine.executed.pop_back();
    CHECK(bench.machine.executed == lines);
    CHECK(bench.machine.alone);
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
    CHECK(bench.machine.held);
    // Held before it runs what waits behind the line: without the hold those would be some twenty.
    CHECK(bench.machine.executed.size() <= 301);
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
        REQUIRE(bench.run(60, [&] { return bench.machine.executed.size() == 100; }));
        bench.machine.receive("\x18");
        REQUIRE(bench.run(5, [&] { return bench.sender.stopped().has_value(); }));
        CHECK(bench.sender.stopped()->kind == StopKind::reset);
    }
    SECTION("lost answers") {
        REQUIRE(bench.run(60, [&] { return bench.machine.executed.size() == 100; }));
        bench.lose_answers = 1000;
        REQUIRE(bench.run(20, [&] { return bench.sender.stopped().has_value(); }));
        CHECK(bench.sender.stopped()->kind == StopKind::lost_count);
    }
    const auto ran = bench.machine.executed.size();
    bench.run(1, [] { return false; });
    CHECK(bench.machine.executed.size() <= ran + 1);
}

TEST_CASE("GRBL is reset only once it stands still") {
    Bench bench;
    for (int i = 0; i < 500; ++i) bench.sender.push("G1X" + std::to_string(i));
    REQUIRE(bench.run(60, [&] { return bench.machine.executed.size() == 100; }));
    bench.sender.halt(bench.now);
    bench.run(1, [] { return false; });
    CHECK(bench.machine.resets == 1);
    CHECK(bench.machine.reset_while_held);
    CHECK(bench.machine.executed.size() <= 101);
}

TEST_CASE("a pause holds GRBL's motion, and nothing is lost") {
    Bench bench;
    for (int i = 0; i < 200; ++i) bench.sender.push("G1X" + std::to_string(i));
    bench.sender.finish();
    REQUIRE(bench.run(60, [&] { return bench.machine.executed.size() == 100; }));
    bench.sender.hold_motion(true);
    bench.run(5, [] { return false; });
    CHECK(bench.machine.executed.size() <= 101);
    CHECK(!bench.sender.stopped());
    bench.sender.hold_motion(false);
    REQUIRE(bench.run(60, [&] { return bench.sender.finished(); }));
    CHECK(bench.machine.executed.size() == 201);
}
