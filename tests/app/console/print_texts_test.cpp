// What a person sees of a print: the most important first, whole, and within the terminal.
#include "app/console/print_texts.h"

#include <catch2/catch.hpp>

namespace print_texts_test {

using namespace lamella;

namespace {

LinkStatus in_mid_print() {
    LinkStatus status;
    status.connected = true;
    status.layer = 11;
    status.lines_answered = 4711;
    status.layers_ready = 1;
    status.z = 2.4;
    status.temperatures = {209.6, 210, 60.2, 60};
    status.progress.layers = 80;
    status.progress.layers_known = 20;
    status.progress.layers_seconds = status.progress.known_seconds = 1200;
    status.progress.done_seconds = status.progress.printing = 660;
    return status;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("percent and time left come first") {
    CHECK(status_text(in_mid_print(), 80) ==
          " 13 %  1:09:00 left  layer 12/80  nozzle 210/210  bed 60/60  Z 2.40  4711 lines  1 layer ready");
}

TEST_CASE("what does not fit is left out whole, and percent and time left stay") {
    LinkStatus status = in_mid_print();
    status.paused = GENERATE(false, true);
    status.lost = GENERATE(false, true);
    status.statistics.advanced = 100;
    status.z = 123.45;
    status.layer = 12344;
    status.lines_answered = 123456789;
    status.progress.layers = 20000;
    status.progress.layers_seconds *= 100;
    status.progress.known_seconds *= 100;
    status.layers_ready = 64;
    const std::string all = status_text(status, 20000);
    for (std::size_t columns = 30; columns <= all.size(); ++columns) {
        const std::string text = status_text(status, 20000, columns);
        REQUIRE(text.size() <= columns);
        CHECK(all.starts_with(text));
        CHECK((text.size() == all.size() || all.compare(text.size(), 2, "  ") == 0));
        CHECK(has(text, " left"));
    }
    CHECK(status_text(status, 20000, 79).size() <= 79);
}

TEST_CASE("heating, pauses and waits are told, and time left does not count them") {
    LinkStatus status = in_mid_print();
    const std::string left = "1:09:00 left";
    status.seconds = 99999;  // since the printer was connected
    SECTION("heating") {
        status.line_wait = LineWait::heat;
        CHECK(has(status_text(status, 80), left + "  heating  "));
    }
    SECTION("paused") {
        status.paused = true;
        CHECK(has(status_text(status, 80), left + "  paused  "));
    }
    SECTION("lost") {
        status.lost = true;
        status.line_wait = LineWait::heat;
        CHECK(has(status_text(status, 80), left + "  the port is gone"));
    }
    SECTION("homing") {
        status.line_wait = LineWait::other;
        CHECK(has(status_text(status, 80), left + "  homing  "));
    }
}

TEST_CASE("a ready file shows its parts and its time left") {
    LinkStatus status = in_mid_print();
    status.progress = {};
    status.progress.layers = 40;
    status.progress.seconds_before = 0;
    status.progress.seconds_ahead = 4000;
    status.layer = 2;
    CHECK(status_text(status, 0, 40) == "  0 %  1:06:40 left  part 3/40");
}

TEST_CASE("a laser has no nozzle, no bed, and is not unknown") {
    LinkStatus status = in_mid_print();
    status.dialect = Dialect::grbl;
    status.emergency_parser = true;
    status.bytes_ahead = 127;
    for (const char* word : {"nozzle", "bed", "Z "}) CHECK(!has(status_text(status, 80), word));
    CHECK(greeting_text(status, false) == "printer: GRBL, up to 127 bytes ahead; Ctrl-C stops it at once");
    status.firmware = "Grbl 1.1h";
    CHECK(has(greeting_text(status, true), "printer: Grbl 1.1h, up to 127 bytes ahead; "));
    status.dialect = Dialect::marlin;
    status.firmware.clear();
    status.bytes_ahead = 0;
    CHECK(has(greeting_text(status, true), "printer: unknown firmware, one line at a time; "));
}

TEST_CASE("one is one, and a port that was lost is in the summary") {
    LinkStatus status;
    status.statistics.lines = status.statistics.timeouts = status.statistics.resends = 1;
    status.statistics.bytes = 2;
    status.underruns = 1;
    std::string text = summary_text(status);
    for (const char* part : {"1 line in", "2 bytes", "1 resend,", "0 lines sent again", "1 timeout,",
                             "0 surplus answers", "no layer ready 1 time ("}) {
        INFO(part << " / " << text);
        CHECK(has(text, part));
    }
    CHECK(!has(text, "port"));
    status.losses = 2;
    status.lost_seconds = 31.25;
    status.statistics.timeouts = 3;
    text = summary_text(status);
    CHECK(has(text, "port lost 2 times (31.2 s)"));
    CHECK(has(text, "3 timeouts"));
}

TEST_CASE("a wait says how it is answered, with keys and without") {
    LinkStatus status;
    CHECK(wait_text(status).empty());
    status.waits = UserWait{"M0 NUT", {"Continue"}};
    CHECK(wait_text(status) == "the printer waits for you: M0 NUT (r: done, 1: Continue)");
    const std::string text = wait_text(status, 4242);
    CHECK(has(text, "waits for you: M0 NUT"));
    CHECK(has(text, "at the printer"));
    CHECK(has(text, "kill -USR1 4242"));
    CHECK(has(text, "kill -INT 4242"));
}

}  // namespace print_texts_test
