// `lamella print` over the socket of a simulated klippy, as its users start it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "printers/serial/gcode_line.h"
#include "tests/app/commands/child_process.h"
#include "tests/app/commands/command_run.h"
#include "tests/printers/serial/klipper_on_socket.h"
#include "tests/printers/serial/simulated_firmware.h"
#include "tests/wait_for.h"

namespace print_klipper_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

const std::string ball = "--shape sphere --shape-radius 2.5 --layer-height 0.25 --printer klipper ";

/// Lines of the ball's G-code file as Klipper gets them.
std::vector<std::string> file_lines(const Folder& folder, const std::string& part = ball) {
    REQUIRE(run_lamella("slice " + part + "-o " + folder / "ball.gcode").code == 0);
    std::istringstream in(contents(folder / "ball.gcode"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (const std::string command = clean_command(line, klipper_lines); !command.empty())
            lines.push_back(command);
    }
    return lines;
}

bool starts_layer(const std::string& line) { return line.starts_with("SET_PRINT_STATS_INFO CURRENT_LAYER="); }

}  // namespace

TEST_CASE("a recipe is printed by Klipper line by line as its file says, and leaves nothing behind") {
    const Folder folder;
    auto wanted = file_lines(folder);
    CHECK(std::count_if(wanted.begin(), wanted.end(), starts_layer) > 10);
    KlipperOnSocket machine({}, 30);
    const Outcome outcome = run_lamella("print " + ball + "--port " + machine.path() + " --journal " +
                                        folder / "journal" + " --log " + folder / "log");
    REQUIRE(outcome.code == 0);
    wanted.emplace_back("M400");
    CHECK(first_difference(machine.executed(), wanted) == "");
    CHECK(!fs::exists(folder / "journal"));
    CHECK(mentions(outcome.err, "printer: Klipper v0.12.0-302-g8f510da, one script at a time"));
    CHECK(mentions(outcome.err, "no layer ready 0 times"));
    CHECK(mentions(contents(folder / "log"), " SET_PRINT_STATS_INFO CURRENT_LAYER=1\n"));
}

TEST_CASE("a print that is stopped on Klipper goes on with the first layer that was not done") {
    const Folder folder;
    const auto file = file_lines(folder);
    KlipperOnSocket machine({}, 20);
    const std::string command =
        "print " + ball + "--port " + machine.path() + " --journal " + folder / "journal";
    const pid_t child = start_lamella(command, folder);
    const std::string marker = "SET_PRINT_STATS_INFO CURRENT_LAYER=10";
    CHECK(wait_for(30, [&] { return count_of(machine.executed(), marker) > 0; }));
    const bool restarts = GENERATE(false, true);
    if (restarts) {
        machine.cut_after(0, true);
        CHECK(exit_code(child) == 3);
        CHECK(mentions(contents(folder / "err"), "the socket was lost"));
    } else {
        kill(child, SIGINT);
        CHECK(exit_code(child) == 130);
        CHECK(mentions(contents(folder / "err"), "heaters were switched off"));
    }
    CHECK(mentions(contents(folder / "err"), "--resume"));
    REQUIRE(wait_for(20, [&] {
        return machine.with([](SimulatedKlipper& klippy, double now) { return klippy.idle(now); });
    }));
    CHECK(!machine.with([](SimulatedKlipper& klippy, double) { return klippy.heating(); }));
    const auto first = machine.executed();
    REQUIRE(run_lamella(command).code == 2);
    REQUIRE(run_lamella(command + " --resume").code == 0);
    auto rest = machine.executed();
    rest.erase(rest.begin(), rest.begin() + std::ssize(first));
    rest.pop_back();  // M400
    CHECK(count_of(rest, "G28") == 0);
    CHECK(count_of(rest, "G28 X Y") == 1);
    const auto is_height = [](const std::string& line) { return line.starts_with("SET_KINEMATIC_POSITION"); };
    CHECK(std::any_of(rest.begin(), rest.end(), is_height) == restarts);
    const auto layer = std::find_if(rest.begin(), rest.end(), starts_layer);
    REQUIRE(layer != rest.end());
    const auto in_file = std::find(file.begin(), file.end(), *layer);
    REQUIRE(in_file != file.end());
    CHECK(first_difference({layer, rest.end()}, {in_file, file.end()}) == "");
    // The layer was begun in the first run, and no other one behind it.
    const auto begun = std::find(first.begin(), first.end(), *layer);
    if (begun != first.end()) CHECK(std::count_if(begun, first.end(), starts_layer) == 1);
}

TEST_CASE("what Klipper refuses is told, with exit code 3") {
    const Folder folder;
    write(folder / "far.gcode", "G28\nG90\nG1 X10 Y10 F6000\nG1 X900\nG1 X20\n");
    KlipperOnSocket machine({}, 20);
    const Outcome outcome = run_lamella("print " + folder / "far.gcode" + " --port " + machine.path() +
                                        " --journal " + folder / "journal");
    CHECK(outcome.code == 3);
    CHECK(mentions(outcome.err, "Move out of range"));
    CHECK(count_of(machine.executed(), "G1 X20") == 0);
}

TEST_CASE("port, firmware and printer have to fit") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\n");
    KlipperOnSocket machine({}, 20);
    const auto [arguments, words] = GENERATE(table<std::string, std::string>(
        {{"--shape sphere --shape-radius 2 --printer marlin --port SOCKET", "--printer klipper"},
         {"--shape sphere --shape-radius 2 --printer marlin --firmware klipper --dry-run",
          "--printer klipper"},
         {"--shape sphere --shape-radius 2 --printer klipper --port SOCKET --firmware marlin", "a socket"},
         {"ready.gcode --port SOCKET --firmware grbl", "--firmware klipper"},
         {"ready.gcode --port /dev/null --firmware klipper", "API socket"},
         {"ready.gcode --port none.sock", "there is no port"}}));
    std::string text = "print " + arguments + " --journal " + folder / "journal";
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"SOCKET", machine.path()},
                                   {"ready.gcode", folder / "ready.gcode"}}) {
        if (const auto at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
    }
    const Outcome outcome = run_lamella(text);
    CHECK(outcome.code == 2);
    CHECK(mentions(outcome.err, words));
    CHECK(machine.executed().empty());
}

TEST_CASE("a dry run for Klipper sends the scripts of the job") {
    const Folder folder;
    const auto file = file_lines(folder);
    const Outcome outcome =
        run_lamella("print " + ball + "--firmware klipper --dry-run --log " + folder / "log");
    REQUIRE(outcome.code == 0);
    CHECK(mentions(outcome.out, std::to_string(file.size()) + " lines"));
    std::istringstream in(contents(folder / "log"));
    std::vector<std::string> sent;
    for (std::string line; std::getline(in, line);) {
        const auto at = line.find(" > ");
        if (at != std::string::npos) sent.push_back(line.substr(line.find(' ', at + 3) + 1));
    }
    REQUIRE(!sent.empty());
    CHECK(sent.back() == "M400");
    sent.pop_back();
    CHECK(first_difference(sent, file) == "");
}

TEST_CASE("the sockets of Klipper are listed among the ports") {
    const Folder folder;
    KlipperOnSocket machine;
    fs::create_directories(folder / "home/printer_1_data/comms");
    fs::rename(machine.path(), folder / "home/printer_1_data/comms/klippy.sock");
    const char* before = std::getenv("HOME");
    const std::string home = before != nullptr ? before : "";
    setenv("HOME", (folder / "home").c_str(), 1);
    const Outcome outcome = run_lamella("ports");
    setenv("HOME", home.c_str(), 1);
    CHECK(outcome.code == 0);
    CHECK(
        mentions(outcome.out, folder / "home/printer_1_data/comms/klippy.sock" + "  API socket of Klipper"));
}

}  // namespace print_klipper_test
