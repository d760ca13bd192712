// KlipperSender against a simulated klippy: pace, order, refusals, pauses, heat, prompts, halts.
#include "printers/serial/klipper_sender.h"

#include <catch2/catch.hpp>

#include "printers/serial/gcode_line.h"
#include "tests/app/commands/mentions.h"
#include "tests/printers/serial/klipper_bench.h"
#include "tests/printers/serial/simulated_firmware.h"

namespace klipper_sender_test {

using namespace lamella;
using namespace lamella::test;

namespace {

bool has(const std::vector<std::string>& list, const std::string& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

TEST_CASE("all lines are executed once and in order, however the bytes are broken up") {
    const auto seed = static_cast<unsigned>(GENERATE(range(0, 20)));
    KlipperBench bench({}, 0.0005, seed);
    REQUIRE(bench.connect());
    CHECK(bench.sender.firmware() == "Klipper v0.12.0-302-g8f510da");
    auto wanted = klipper_start;
    for (const std::string& line : short_moves(500)) wanted.push_back(line);
    bench.push(wanted);
    REQUIRE(bench.finish(120));
    CHECK(bench.sender.finished());
    CHECK(bench.sender.answered() == static_cast<std::int64_t>(wanted.size()));
    auto executed = bench.klippy.executed();
    CHECK(executed.back() == "M400");
    executed.pop_back();
    std::erase(executed, "M104 S200");
    CHECK(first_difference(executed, wanted) == "");
    CHECK(bench.klippy.malformed() == 0);
    CHECK(bench.klippy.most_scripts() == 1);
}

TEST_CASE("a machine with one script on its way never runs dry, not even with a slow connection") {
    const double latency = GENERATE(0.0, 0.005, 0.05);
    KlipperBench bench({}, latency);
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    // 200 lines a second at 100 mm/s.
    bench.push(short_moves(4000));
    REQUIRE(bench.finish(120));
    CHECK(bench.sender.finished());
    CHECK(bench.klippy.dry() == 0);
}

TEST_CASE("a script is short, so that a pause is heard") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.push(short_moves(300));
    bench.push({"G1 X110 F600", "G1 X10", "G1 X110"});
    REQUIRE(bench.finish(120));
    for (const auto& script : bench.klippy.scripts()) CHECK(script.size() <= 64);
    // Each of the moves of ten seconds is one of its own.
    CHECK(bench.klippy.scripts().size() >= 3 + 300 / 64 + 3);
    for (const char* alone : {"M109 S200", "G28", "G1 X110"}) {
        CHECK(std::any_of(bench.klippy.scripts().begin(), bench.klippy.scripts().end(),
                          [&](const auto& script) { return script == std::vector<std::string>{alone}; }));
    }
}

TEST_CASE("no line is sent behind a refused one, and what Klipper says is told") {
    const int at = GENERATE(0, 1, 63, 64, 100, 299);
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    const auto lines = short_moves(300);
    bench.klippy.refuse_next(lines[static_cast<std::size_t>(at)],
                             "Move out of range: 999.000 1.000 2.000 [3.000]");
    bench.push(lines);
    bench.finish(120);
    REQUIRE(bench.sender.refused());
    CHECK(mentions(*bench.sender.refused(), "Move out of range: 999.000 1.000 2.000 [3.000]"));
    CHECK(!bench.sender.stopped());
    CHECK(!bench.sender.finished());
    const auto moves = moves_of(bench.klippy.executed());
    CHECK(first_difference(moves, {lines.begin(), lines.begin() + at}) == "");
    bench.run(5);
    CHECK(moves_of(bench.klippy.executed()).size() == moves.size());
    // It still takes lines of the host, each for itself.
    bench.sender.interject("G0 X900 F6000");
    bench.sender.interject("G0 Y10");
    bench.sender.interject("M104 S0");
    REQUIRE(bench.run_until(20, [&] { return bench.sender.quiet() && !bench.klippy.heating(); }));
    CHECK(!has(bench.klippy.executed(), "G0 Y10"));
}

TEST_CASE("Klipper's errors are those of its machine") {
    const auto [line, words] = GENERATE(table<std::string, std::string>(
        {{"G1 X10 Y10 F6000", "Must home axis first"},
         {"G1 E5 F300", "Extrude below minimum temp / See the 'min_extrude_temp'"},
         {"M104 S900", "out of range"}}));
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push({line, "G90"});
    bench.finish(20);
    REQUIRE(bench.sender.refused());
    CHECK(mentions(*bench.sender.refused(), words));
    CHECK(mentions(*bench.sender.refused(), line));
    CHECK(!has(bench.klippy.executed(), "G90"));
}

TEST_CASE("an unknown command is told once, and does not end the job") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(
        {"SET_PRINT_STATS_INFO CURRENT_LAYER=1", "M73 P1", "SET_PRINT_STATS_INFO CURRENT_LAYER=2", "G90"});
    REQUIRE(bench.finish(20));
    CHECK(bench.sender.finished());
    CHECK(bench.messages ==
          std::vector<std::string>{"Unknown command:\"SET_PRINT_STATS_INFO\"", "Unknown command:\"M73\""});
}

TEST_CASE("a Klipper that starts is waited for; one that cannot print is refused with its own words") {
    KlipperOptions options;
    options.startup = 3;
    KlipperBench slow(options);
    slow.run(1);
    CHECK(!slow.sender.connected());
    CHECK(mentions(slow.sender.remark(), "Printer is not ready"));
    REQUIRE(slow.connect());

    options = {};
    options.trouble = "mcu 'mcu': Unable to connect\nOnce the underlying issue is corrected";
    KlipperBench broken(options);
    CHECK(!broken.connect());
    REQUIRE(broken.sender.stopped());
    CHECK(mentions(broken.sender.stopped()->why, "its state is error"));
    CHECK(mentions(broken.sender.stopped()->why, "mcu 'mcu': Unable to connect / Once"));

    options = {};
    options.own_file = "benchy.gcode";
    KlipperBench busy(options);
    CHECK(!busy.connect());
    CHECK(mentions(busy.sender.stopped()->why, "benchy.gcode"));
    CHECK(busy.klippy.scripts().empty());
}

TEST_CASE("a shutdown ends the job with its reason") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.push(short_moves(2000));
    bench.run_until(30, [&] { return bench.klippy.executed().size() > 400; });
    bench.klippy.shut_down("MCU 'mcu' shutdown: Timer too close", bench.now);
    const std::size_t executed = bench.klippy.executed().size();
    REQUIRE(bench.run_until(2, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(bench.sender.stopped()->kind == StopKind::fatal);
    CHECK(mentions(bench.sender.stopped()->why, "MCU 'mcu' shutdown: Timer too close"));
    CHECK(bench.klippy.executed().size() == executed);
}

TEST_CASE("a pause keeps lines from being sent within one script") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    const auto lines = short_moves(2000);
    bench.push(lines);
    bench.run_until(30, [&] { return bench.sender.answered() > 500; });
    const std::size_t scripts = bench.klippy.scripts().size();
    bench.sender.hold(true);
    bench.run(5);
    CHECK(bench.klippy.scripts().size() <= scripts + 1);
    CHECK(bench.sender.quiet());
    bench.sender.hold(false);
    REQUIRE(bench.finish(60));
    CHECK(first_difference(moves_of(bench.klippy.executed()), lines) == "");
}

TEST_CASE("a pause that another program asks for is heard, and Klipper itself resumes") {
    KlipperOptions options;
    options.old_words = GENERATE(false, true);
    KlipperBench bench(options);
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    const auto lines = short_moves(1000);
    bench.push(lines);
    bench.run_until(30, [&] { return bench.sender.answered() > 300; });
    bench.klippy.run_of_another("PAUSE");
    REQUIRE(bench.run_until(5, [&] { return !bench.actions.empty(); }));
    CHECK(bench.actions == std::vector<std::string>{"paused"});
    bench.run(5);
    const std::size_t executed = bench.klippy.executed().size();
    bench.run(5);
    CHECK(bench.klippy.executed().size() == executed);
    REQUIRE(bench.klippy.paused());
    bench.sender.hold_motion(false);
    bench.sender.hold(false);
    REQUIRE(bench.finish(60));
    CHECK(bench.klippy.executed()[executed] == "RESUME");
    CHECK(first_difference(moves_of(bench.klippy.executed()), lines) == "");
}

TEST_CASE("a macro that pauses is alone, so that nothing is behind it") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.push(short_moves(20));
    bench.push({"PAUSE"});
    bench.push(short_moves(20, 20));
    REQUIRE(bench.run_until(30, [&] { return !bench.actions.empty(); }));
    bench.run(3);
    CHECK(bench.klippy.executed().back() == "PAUSE");
}

TEST_CASE("a pause that was left behind is cleared before the job begins") {
    KlipperBench bench;
    bench.klippy.run_of_another("PAUSE");
    bench.run(0.001);
    REQUIRE(bench.klippy.paused());
    REQUIRE(bench.connect());
    bench.push({"G90"});
    REQUIRE(bench.finish(5));
    CHECK(bench.klippy.executed() == std::vector<std::string>{"PAUSE", "CLEAR_PAUSE", "G90", "M400"});
}

TEST_CASE("an emergency stop does not wait for the scripts") {
    KlipperBench bench({}, 0.002);
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.push(short_moves(3000));
    bench.run_until(30, [&] { return bench.sender.answered() > 1000; });
    const double before = bench.now;
    bench.sender.halt(bench.now);
    REQUIRE(bench.run_until(1, [&] { return bench.klippy.is_shut_down(); }));
    CHECK(bench.klippy.shut_down_at() - before < 0.05);
    CHECK(!bench.klippy.heating());
    // Of a script that was cut in the middle nothing is executed.
    CHECK(bench.klippy.malformed() <= 1);
}

TEST_CASE("a heater is waited for by the host, which can be called off") {
    KlipperOptions options;
    options.heating_rate = 10;
    KlipperBench bench(options);
    REQUIRE(bench.connect());
    bench.push({"M190 S60", "M109 S200", "G90"});
    REQUIRE(bench.run_until(10, [&] { return bench.sender.line_wait() == LineWait::heat; }));
    bench.run(2);
    CHECK(bench.klippy.executed() == std::vector<std::string>{"M140 S60"});
    CHECK(bench.sender.temperatures().bed_target == 60);
    CHECK(bench.sender.temperatures().bed > 30);
    SECTION("it goes on when it is warm") {
        REQUIRE(bench.finish(60));
        CHECK(bench.klippy.executed() ==
              std::vector<std::string>{"M140 S60", "M190 S60", "M104 S200", "M109 S200", "G90", "M400"});
    }
    SECTION("it is called off at once") {
        bench.sender.drop_pending();
        bench.sender.end_waiting();
        CHECK(bench.sender.line_wait() == LineWait::none);
        bench.sender.interject("M140 S0");
        REQUIRE(bench.run_until(1, [&] { return !bench.klippy.heating(); }));
    }
    SECTION("somebody else sets another temperature") {
        bench.klippy.run_of_another("M140 S30");
        REQUIRE(bench.finish(60));
        CHECK(has(bench.klippy.executed(), "M190 S60"));
    }
}

TEST_CASE("a prompt is shown, and its button runs its command") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    for (const char* text : {"prompt_begin Filament", "prompt_text Change it",
                             "prompt_button Done|RESUME|primary", "prompt_button M117", "prompt_show"})
        bench.klippy.run_of_another("RESPOND TYPE=command MSG=\"action:" + std::string(text) + "\"");
    REQUIRE(bench.run_until(5, [&] { return bench.sender.user_wait().has_value(); }));
    CHECK(bench.sender.user_wait()->text == "Filament: Change it");
    CHECK(bench.sender.user_wait()->buttons == std::vector<std::string>{"Done", "M117"});
    bench.sender.choose(GENERATE(0U, 1U));
    CHECK(!bench.sender.user_wait());
    bench.run(1);
    const std::string last = bench.klippy.executed().back();
    CHECK((last == "RESUME" || last == "M117"));
}

TEST_CASE("a long pause does not let Klipper switch off") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.push(short_moves(5));
    bench.run_until(30, [&] { return bench.sender.idle(); });
    bench.run(200);
    const auto& executed = bench.klippy.executed();
    CHECK(std::count(executed.begin(), executed.end(), "G4 P1") == 3);
    CHECK(bench.overdue == 0);
}

TEST_CASE("while a script takes long, nothing is due") {
    KlipperOptions options;
    options.heating_rate = 0.01;
    KlipperBench bench(options);
    REQUIRE(bench.connect());
    bench.run(100);
    bench.push({"G90", "M190 S26.5"});
    bench.run(200);
    CHECK(has(bench.klippy.executed(), "M190 S26.5"));
    CHECK(bench.sender.line_wait() == LineWait::none);
    CHECK(bench.overdue == 0);
}

TEST_CASE("a klippy that says nothing any more ends the job") {
    KlipperBench bench;
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.run(1);
    bench.deaf = true;
    REQUIRE(bench.run_until(100, [&] { return bench.sender.stopped().has_value(); }));
    CHECK(mentions(bench.sender.stopped()->why, "silent"));
    CHECK(bench.overdue == 0);
}

TEST_CASE("a lost socket ends the job, unless it has not begun") {
    KlipperBench bench;
    bench.run(0.001);
    bench.cut();
    CHECK(!bench.sender.stopped());
    bench.sender.reconnect(bench.now);
    REQUIRE(bench.connect());
    bench.push(klipper_start);
    bench.run(1);
    bench.cut();
    REQUIRE(bench.sender.stopped());
    CHECK(bench.sender.stopped()->kind == StopKind::reset);
}

TEST_CASE("names keep their letters, and what follows a semicolon is no part of them") {
    CHECK(clean_command("exclude_object_start name=Ball_1 ; first", klipper_lines) ==
          "EXCLUDE_OBJECT_START name=Ball_1");
    CHECK(clean_command("SET_PIN PIN=lamp VALUE=0.50", klipper_lines) == "SET_PIN PIN=lamp VALUE=0.50");
    CHECK(clean_command("g1 x1.500 (aside) y2", klipper_lines) == "G1 X1.5 Y2");
    CHECK(clean_command("RESPOND MSG=\"a (b)\"", klipper_lines) == "RESPOND MSG=\"a (b)\"");
    CHECK(clean_command("PAUSE", klipper_lines) == "PAUSE");
}

TEST_CASE("messages come whole from any pieces, and what is none is dropped") {
    KlipperFrames frames;
    frames.feed("{\"id\":1}\x03{\"i");
    CHECK(frames.next() == "{\"id\":1}");
    CHECK(!frames.next());
    frames.feed("d\":2}\x03\x03");
    CHECK(frames.next() == "{\"id\":2}");
    CHECK(frames.next() == "");
    CHECK(!parse_klipper_message(""));
    CHECK(!parse_klipper_message("[1]"));
    CHECK(!parse_klipper_message("{\"id\":"));
    CHECK(parse_klipper_message("{\"id\":7,\"error\":{\"message\":\"no\"}}")->error == "no");
    CHECK(parse_klipper_message("{\"id\":7,\"result\":{}}")->id == 7);
    // A message without an end does not fill the memory, and the next one is read.
    for (int i = 0; i < 6; ++i) {
        frames.feed(std::string(1 << 20, 'x'));
        CHECK(!frames.next());
    }
    frames.feed("\x03{\"id\":3}\x03");
    CHECK(frames.next() == "{\"id\":3}");
}

}  // namespace klipper_sender_test
