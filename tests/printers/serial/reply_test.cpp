// Replies as real firmware sends them, split anywhere, and noise that is no answer.
#include "printers/serial/reply.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "printers/serial/gcode_line.h"
#include "printers/serial/grbl_sender.h"
#include "printers/serial/marlin_sender.h"

namespace reply_test {

using namespace lamella;

TEST_CASE("answers of Marlin are told apart") {
    CHECK(parse_reply("ok").kind == ReplyKind::ok);
    const Reply advanced = parse_reply("ok N16 P0 B2");
    CHECK(advanced.kind == ReplyKind::ok);
    CHECK(advanced.number == 16);
    CHECK(advanced.planner_free == 0);
    CHECK(advanced.slots_free == 2);
    CHECK(!parse_reply("ok P15 B3").number);
    const Reply hot = parse_reply("ok T:21.5 /210.0 B:60.0 /60.0 @:127 B@:3");
    CHECK(hot.kind == ReplyKind::ok);
    CHECK(!hot.slots_free);
    REQUIRE(hot.temperatures);
    CHECK(hot.temperatures->nozzle == 21.5);
    CHECK(hot.temperatures->nozzle_target == 210);
    CHECK(hot.temperatures->bed == 60);
    CHECK(parse_reply(" T:37.58 /60.00 B:25.00 /0.00 @:127 B@:0 W:?").kind == ReplyKind::heating);
    CHECK(parse_reply(" T:25.00 /0.00 B:25.00 /0.00 @:0 B@:0").kind == ReplyKind::temperatures);
    CHECK(parse_reply("echo:busy: processing").kind == ReplyKind::busy);
    CHECK(parse_reply("echo:busy: paused for user").kind == ReplyKind::busy);
    CHECK(parse_reply("start").kind == ReplyKind::reset);
    CHECK(parse_reply("echo: Watchdog Reset").kind == ReplyKind::reset);
    CHECK(parse_reply("Grbl 1.1h ['$' for help]").kind == ReplyKind::grbl_banner);
    CHECK(parse_reply("//action:pause").text == "pause");
    CHECK(parse_reply("Cap:EMERGENCY_PARSER:1").text == "EMERGENCY_PARSER:1");
    CHECK(parse_reply("FIRMWARE_NAME:Marlin 2.1.2.1 (x)").kind == ReplyKind::firmware);
}

TEST_CASE("every spelling of a resend names its line") {
    for (const char* text : {"Resend: 42", "Resend:42", "rs 42", "rs N42", "Resend: N:42", "Resend: 42ok"}) {
        INFO(text);
        const Reply reply = parse_reply(text);
        CHECK(reply.kind == ReplyKind::resend);
        CHECK(reply.number == 42);
    }
    for (const char* text : {"Resend", "Resend: ", "rs", "rss 4", "Resend: x", "Rsend: 4"}) {
        INFO(text);
        CHECK(parse_reply(text).kind != ReplyKind::resend);
    }
}

TEST_CASE("errors are about a line, or the end of the print, or neither") {
    CHECK(parse_reply("Error:checksum mismatch, Last Line: 1").kind == ReplyKind::line_error);
    CHECK(parse_reply("Error:No Checksum with line number, Last Line: 2").kind == ReplyKind::line_error);
    CHECK(parse_reply("Error:Line Number is not Last Line Number+1, Last Line: 2").kind ==
          ReplyKind::line_error);
    CHECK(parse_reply("Error:Printer halted. kill() called!").kind == ReplyKind::fatal);
    CHECK(parse_reply("Error:Thermal Runaway, system stopped! Heater_ID: 0").kind == ReplyKind::fatal);
    for (const char* text :
         {"!! Shutdown", "fatal: heater", "Error:Heating failed, system stopped! Heater_ID: bed",
          "Error:MINTEMP triggered, system stopped! Heater_ID: 0", "Error:MAXTEMP triggered",
          "Error:EMERGENCY SHUTDOWN", "echo:kill() called"}) {
        INFO(text);
        CHECK(parse_reply(text).kind == ReplyKind::fatal);
    }
    CHECK(parse_reply("Error:volume.init failed").kind == ReplyKind::error);
    CHECK(parse_reply("error:20").kind == ReplyKind::grbl_error);
    CHECK(parse_reply("ALARM:3").kind == ReplyKind::grbl_alarm);
}

TEST_CASE("what is not an ok does not count as one") {
    for (const char* text : {"", "o", "k", "okay", "okok", "ok\x80", "OK", " ok", "?ok", "echo:ok",
                             "X:0.00 Y:0.00 Count X:0", "S_XYZ:5", "okN5", "SD card ok"}) {
        INFO(text);
        CHECK(parse_reply(text).kind == ReplyKind::other);
    }
    ReplyLines lines;
    lines.feed("\xF0o\x80k\nok\r\n\r\n");
    CHECK(parse_reply(*lines.next()).kind == ReplyKind::other);
    CHECK(parse_reply(*lines.next()).kind == ReplyKind::ok);
    CHECK(lines.next() == "");
    CHECK(!lines.next());
}

TEST_CASE("lines come out the same wherever they were split") {
    const std::string text = "start\nok N1 P2 B3\r\n T:20 /0\nResend: 7\nok\n";
    for (std::size_t cut = 0; cut <= text.size(); ++cut) {
        ReplyLines lines;
        std::vector<std::string> found;
        for (const std::string& piece : {text.substr(0, cut), text.substr(cut)}) {
            lines.feed(piece);
            while (auto line = lines.next()) found.push_back(*line);
        }
        CHECK(found == std::vector<std::string>{"start", "ok N1 P2 B3", " T:20 /0", "Resend: 7", "ok"});
    }
}

TEST_CASE("lines that are sent are short, clean and summed") {
    CHECK(clean_command("g1  x1.500 Y2.0 ; a comment") == "G1 X1.5 Y2");
    CHECK(clean_command("(all) G1 (here) X-.50") == "G1 X-.5");
    CHECK(clean_command("N12 G28 X*77") == "G28 X");
    CHECK(clean_command("M117 Hello (you)") == "M117 Hello (you)");
    CHECK(clean_command("m0 Next board") == "M0 Next board");
    CHECK(clean_command("M117 " + std::string(100, 'a')) == "M117 " + std::string(longest_command - 5, 'a'));
    CHECK(clean_command("M23 part.gco") == "M23 part.gco");
    CHECK_THROWS_AS(clean_command("M23 " + std::string(100, 'a')), InputError);
    for (const char* nothing : {"", "   ", "; only a comment", "%", "M110 N5", "(x)"})
        CHECK(clean_command(nothing).empty());
    CHECK_THROWS_AS(clean_command("G1 X" + std::string(100, '1')), InputError);
    CHECK_THROWS_AS(clean_command("hello \xC3\xA4"), InputError);
    CHECK_THROWS_AS(clean_command("1 2 3"), InputError);
    CHECK(numbered_line(0, "M110 N0") == "N0 M110 N0*125\n");
    CHECK(numbered_line(99999999, std::string(longest_command, 'G')).size() <= longest_marlin_line + 1);
}

TEST_CASE("a number ends where the next word begins, and infinity is none") {
    CHECK(command_value("G1X10E5", 'X') == 10.0);
    CHECK(command_value("G1X10E5", 'E') == 5.0);
    CHECK(command_value("G1 XINF Y2", 'Y') == 2.0);
    CHECK_FALSE(command_value("G1 XINF Y2", 'X'));
    CHECK_FALSE(command_value("G1 XNAN", 'X'));
}

TEST_CASE("no noise makes a sender crash, send without end, or take an answer from it") {
    const unsigned seed = GENERATE(range(1U, 9U));
    std::mt19937 random(seed);
    const std::vector<std::string> words{
        "ok", "ok N",   "Resend: ", "rs N",  "error:", "ALARM:", "T:",        " B:",
        "\n", "<Idle|", ">",        "[OPT:", "]",      "Cap:",   "1",         "99999999999999999999",
        "-1", ".",      "/",        "busy:", "Error:", "echo:",  "//action:", "P",
        "B",  " ",      "\r",       "\x80",  "e",      "W:"};
    MarlinSender marlin({}, {});
    GrblSender grbl({}, {});
    for (LineSender* sender : {static_cast<LineSender*>(&marlin), static_cast<LineSender*>(&grbl)}) {
        sender->connect(0);
        for (int i = 0; i < 100; ++i) sender->push("G1 X" + std::to_string(i));
        double now = 0;
        for (int i = 0; i < 20000; ++i) {
            std::string bytes;
            for (std::size_t k = random() % 6; k > 0; --k) bytes += words[random() % words.size()];
            sender->receive(bytes, now += 0.01);
            sender->tick(now);
            REQUIRE(sender->output().size() < 5000);
            sender->wrote(sender->output().size());
            REQUIRE(sender->answered() <= 100);
        }
    }
    // Bytes without a line end or an "ok" at a line's beginning answer nothing.
    MarlinSender deaf({}, {});
    deaf.connect(0);
    for (int i = 0; i < 20000; ++i) {
        std::string bytes;
        for (int k = 0; k < 8; ++k) bytes += static_cast<char>(random() % 256);
        for (char& c : bytes) c = c == 'k' ? 'j' : c;
        deaf.receive(bytes, i * 1e-4);
        deaf.tick(i * 1e-4);
    }
    CHECK(!deaf.connected());
}

TEST_CASE("no character on which GRBL acts at once is sent within a line") {
    CHECK(clean_command("M0 (next sheet! ready?)", grbl_lines) == "M0");
    CHECK(clean_command("M1 (turn it ~)", grbl_lines) == "M1");
    CHECK(clean_command("G1 X1 ; what now?!", grbl_lines) == "G1 X1");
    CHECK(clean_command("(a; b!) G1 X1", grbl_lines) == "G1 X1");
    CHECK(clean_command("M30 (end?)", grbl_lines) == "M30");
    for (const char* line : {"G0 X1 ! Y1", "M0 ready?", "$N0=G1~", "M117 hello!", "M23 what?.nc", "~", "?"}) {
        INFO(line);
        CHECK_THROWS_AS(clean_command(line, grbl_lines), InputError);
    }
    // Whatever is accepted is free of them.
    std::mt19937 random(7);
    const std::string signs = "GMXYZSF 0123456789.-;()!~?$=\n";
    int sent = 0;
    for (int i = 0; i < 200000; ++i) {
        std::string line = random() % 2 == 0 ? "G1" : "M0";
        for (std::size_t k = random() % 12; k > 0; --k) line += signs[random() % signs.size()];
        try {
            const std::string command = clean_command(line, grbl_lines);
            CHECK(command.find_first_of("!~?") == std::string::npos);
            ++sent;
        } catch (const InputError&) {
            CHECK(line.find_first_of("!~?(") != std::string::npos);
        }
    }
    CHECK(sent > 1000);
    // Marlin has none, and shows them.
    CHECK(clean_command("M0 ready?") == "M0 ready?");
}

TEST_CASE("GRBL's version is read from its build line") {
    const Reply reply = parse_reply("[VER:1.1h.20190830:my laser]");
    CHECK(reply.kind == ReplyKind::grbl_version);
    CHECK(reply.text == "1.1h");
    CHECK(parse_reply("[VER:0.9]").text == "0.9");
}

TEST_CASE("what a machine tells people is told apart from answers and reports") {
    CHECK(message_of(parse_reply("echo:  Unknown command: \"G999\"")) == "Unknown command: \"G999\"");
    CHECK(message_of(parse_reply("Error:Thermal Runaway")) == "Error:Thermal Runaway");
    CHECK(message_of(parse_reply("Error:no such macro")) == "Error:no such macro");
    CHECK(message_of(parse_reply("//action:notification Heating")) == "Heating");
    for (const char* line : {"ok", "ok T:21.5 /210.0 B:60.0 /60.0", " T:25.00 /0.00 B:25.00 /0.00",
                             "Resend: 5", "echo:busy: processing", "Error:checksum mismatch, Last Line: 1",
                             "//action:pause", "X:10.00 Y:0.00 Count X:800", "S_XYZ:5", "echo:", "start"}) {
        INFO(line);
        CHECK(message_of(parse_reply(line)).empty());
    }
}

}  // namespace reply_test
