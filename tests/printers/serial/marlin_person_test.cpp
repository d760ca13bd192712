// A Marlin that waits for a person: for as long as it takes, told, and ended by the person alone.
#include <catch2/catch.hpp>

#include "tests/printers/serial/marlin_bench.h"

namespace marlin_person_test {

using namespace lamella;
using namespace lamella::test;

namespace {

std::vector<std::string> moves_with(const std::string& line, std::size_t at) {
    auto lines = moves(60, 0.01);
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), line);
    return lines;
}

/// Starts the job and runs it until the sender says that the printer waits.
void run_to_wait(MarlinBench& bench, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) bench.sender.push(line);
    bench.sender.finish();
    REQUIRE(bench.run(30, [&] { return bench.printer.waits_for_user() && bench.sender.user_wait(); }));
}

}  // namespace

TEST_CASE("M0 is waited in for hours without a time-out, and M108 ends it past every buffer") {
    FirmwareOptions options;
    options.emergency_parser = GENERATE(false, true);
    options.keepalive = GENERATE(false, true);
    options.advanced_ok = GENERATE(false, true);
    MarlinBench bench(options);
    const auto lines = moves_with("M0 PUT THE NUT IN", 30);
    run_to_wait(bench, lines);
    CHECK(bench.sender.user_wait()->text == "M0 PUT THE NUT IN");
    CHECK(bench.sender.user_wait()->buttons.empty());
    bench.run(1000, [] { return false; });
    CHECK(!bench.sender.stopped());
    CHECK(bench.printer.waits_for_user());
    CHECK(job_lines(bench.printer.executed()).size() == 31);
    bench.sender.end_waiting();
    REQUIRE(bench.run(100, [&] { return bench.sender.finished() || bench.sender.stopped(); }));
    CHECK(!bench.sender.stopped());
    CHECK(!bench.sender.user_wait());
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK(bench.sender.answered() == 61);
    CHECK(bench.printer.lost_bytes() == 0);
}

TEST_CASE("a dialog of the printer is shown with its buttons, and only a person presses one") {
    FirmwareOptions options;
    options.emergency_parser = options.host_prompts = true;
    MarlinBench bench(options);
    const auto lines = moves_with("M0", 30);
    run_to_wait(bench, lines);
    bench.run(100, [] { return false; });
    REQUIRE(bench.sender.user_wait());
    CHECK(bench.sender.user_wait()->text == "M0 Stop");
    CHECK(bench.sender.user_wait()->buttons == std::vector<std::string>{"Continue"});
    CHECK(bench.printer.waits_for_user());
    bench.sender.choose(7);
    bench.run(1, [] { return false; });
    CHECK(bench.printer.waits_for_user());
    bench.sender.choose(0);
    REQUIRE(bench.run(100, [&] { return bench.sender.finished(); }));
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    const auto& executed = bench.printer.executed();
    CHECK(std::count(executed.begin(), executed.end(), "M876 S0") == 1);
}

TEST_CASE("a heat-up can be ended without an emergency parser, for nothing stands before the M108") {
    MarlinBench bench({});
    std::vector<std::string> lines{"M109 S240"};
    for (int i = 0; i < 20; ++i) lines.emplace_back("M106 S1");
    for (const std::string& line : lines) bench.sender.push(line);
    REQUIRE(bench.run(10, [&] { return bench.printer.heating(); }));
    bench.run(0.5, [] { return false; });
    const double before = bench.now;
    bench.sender.end_waiting();
    REQUIRE(bench.run(10, [&] { return job_lines(bench.printer.executed()).size() == 21; }));
    CHECK(bench.now - before < 1);
}

TEST_CASE("homing may take longer than any patience where the firmware never says that it is busy") {
    FirmwareOptions options;
    options.keepalive = false;
    MarlinBench bench(options);
    const std::vector<std::string> lines{"G4 S2000", "G1 X10 F6000"};
    REQUIRE(bench.print(lines, 3000));
    CHECK(!bench.sender.stopped());
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK(bench.printer.lost_bytes() == 0);
}

TEST_CASE("unknown firmware gets one line at a time") {
    FirmwareOptions options;
    options.name = "Sprinter";
    options.old = true;
    MarlinBench bench(options);
    bench.printer.run(0);  // its greeting, which names Marlin, is lost
    REQUIRE(bench.print(moves(300), 100));
    CHECK(!bench.sender.stopped());
    CHECK(bench.max_unanswered < 40);
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(300)) == "");
}

TEST_CASE("within the slots that the printer tells, no line waits in its receive buffer") {
    SenderSettings settings;
    settings.within_slots = GENERATE(false, true);
    FirmwareOptions options;
    options.advanced_ok = true;
    options.line_time = 0.02;
    MarlinBench bench(options, settings);
    std::vector<std::string> lines;
    for (int i = 0; i < 300; ++i) lines.push_back("M106 S" + std::to_string(i % 200));
    REQUIRE(bench.print(lines, 100));
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK((bench.printer.fullest() <= 32) == settings.within_slots);
}

TEST_CASE("a line that is not kept any more is believed lost only when it is asked for twice") {
    MarlinBench bench({});
    for (const std::string& line : moves(3000)) bench.sender.push(line);
    bench.sender.finish();
    REQUIRE(bench.run(60, [&] { return bench.printer.executed().size() > 2500; }));
    const bool again = GENERATE(false, true);
    bench.printer.say("Resend: 3");
    if (again) bench.printer.say("Resend: 3");
    REQUIRE(bench.run(60, [&] { return bench.sender.finished() || bench.sender.stopped(); }));
    REQUIRE(bench.sender.stopped().has_value() == again);
    if (again) CHECK(bench.sender.stopped()->why.find("line 3 ") != std::string::npos);
    if (!again) CHECK(first_difference(job_lines(bench.printer.executed()), moves(3000)) == "");
}

TEST_CASE("a dialog that the printer never ends is over when its line is answered") {
    FirmwareOptions options;
    options.emergency_parser = GENERATE(false, true);
    MarlinBench bench(options);
    const auto lines = moves_with("M600", 30);
    run_to_wait(bench, lines);
    bench.run(100, [] { return false; });
    REQUIRE(bench.sender.user_wait());
    CHECK(bench.sender.user_wait()->text == "Nozzle Parked");
    bench.printer.press_knob();
    REQUIRE(bench.run(10, [&] { return !bench.sender.user_wait(); }));
    const auto done = job_lines(bench.printer.executed()).size();
    CHECK(done < 61);
    REQUIRE(bench.run(100, [&] { return bench.sender.finished() || bench.sender.user_wait(); }));
    CHECK(!bench.sender.user_wait());
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
}

TEST_CASE("once all lines are with the printer a pause is not taken, before that it is done") {
    MarlinBench bench({});
    for (const std::string& line : moves(40, 0.5)) bench.sender.push(line);
    bench.sender.finish();
    const bool late = GENERATE(false, true);
    REQUIRE(bench.run(60, [&] { return late ? !bench.sender.can_pause() : bench.sender.pending() == 20; }));
    CHECK(bench.sender.can_pause() == !late);
    bench.sender.hold(true);
    bench.run(60, [] { return false; });
    // Held, it does not end by itself.
    CHECK(!bench.sender.finished());
    bench.sender.hold(false);
    REQUIRE(bench.run(60, [&] { return bench.sender.finished(); }));
    CHECK(first_difference(job_lines(bench.printer.executed()), moves(40, 0.5)) == "");
}

}  // namespace marlin_person_test
