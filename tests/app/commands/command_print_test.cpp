// `lamella print` as its users start it, against a simulated printer behind a pseudo-terminal.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "printers/serial/gcode_line.h"
#include "tests/app/commands/child_process.h"
#include "tests/app/commands/command_run.h"
#include "tests/printers/serial/pty_machine.h"

namespace command_print_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

const std::string part =
    "--shape sphere --shape-radius 2.5 --layer-height 0.25 --printer marlin --greeting 0.2 ";

/// Lines of a G-code file as a printer gets them.
std::vector<std::string> clean_lines(const std::string& path) {
    std::ifstream in(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (const std::string command = clean_command(line); !command.empty()) lines.push_back(command);
    }
    return lines;
}

/// Whether a journal is written that knows of all that was until now; it is written at least every two
/// seconds.
bool journal_follows(const std::string& journal) {
    const auto settled = fs::file_time_type::clock::now() + std::chrono::seconds(1);
    std::error_code absent;
    return wait_for(30, [&] { return fs::last_write_time(journal, absent) > settled && !absent; });
}

}  // namespace

TEST_CASE("a recipe is printed line by line as its file says, and leaves nothing behind") {
    FirmwareOptions firmware;
    firmware.advanced_ok = GENERATE(false, true);
    const Folder folder;
    REQUIRE(run_lamella("slice " + part.substr(0, part.find("--greeting")) + "-o " + folder / "ball.gcode")
                .code == 0);
    PtyMachine machine(firmware, 30);
    const Outcome outcome = run_lamella("print " + part + "--port " + machine.path() + " --journal " +
                                        folder / "journal" + " --log " + folder / "log");
    REQUIRE(outcome.code == 0);
    CHECK(first_difference(job_lines(machine.executed()), clean_lines(folder / "ball.gcode")) == "");
    CHECK(!fs::exists(folder / "journal"));
    CHECK(mentions(outcome.err, "0 resends"));
    CHECK(mentions(outcome.err, "Marlin 2.1.2.1"));
    CHECK(mentions(contents(folder / "log"), " N0 M110 N0*125"));
    if (firmware.advanced_ok) CHECK(mentions(outcome.err, "starved"));
}

TEST_CASE("a print whose host is killed goes on with the first layer that was not done") {
    const Folder folder;
    REQUIRE(run_lamella("slice " + part.substr(0, part.find("--greeting")) + "-o " + folder / "ball.gcode")
                .code == 0);
    const auto file = clean_lines(folder / "ball.gcode");
    PtyMachine machine({}, 20);
    const std::string command =
        "print " + part + "--port " + machine.path() + " --journal " + folder / "journal";
    const pid_t child = start_lamella(command, folder);
    const std::string marker = "M73 P50";
    const bool there = wait_for(30, [&] { return count_of(machine.executed(), marker) > 0; });
    // This machine is 20 times as fast as a real one, the disk is not: it waits for the journal.
    machine.stand_still(true);
    const bool written = journal_follows(folder / "journal");
    kill(child, SIGKILL);
    exit_code(child);
    machine.stand_still(false);
    REQUIRE(there);
    REQUIRE(written);
    const Outcome without = run_lamella(command);
    CHECK(without.code == 2);
    CHECK(mentions(without.err, "--resume"));
    const Outcome other = run_lamella(command + " --resume --shape-radius 2.75");
    CHECK(other.code == 2);
    REQUIRE(wait_for(30, [&] { return machine.with([](auto& printer, double) { return printer.idle(); }); }));
    const auto first = job_lines(machine.executed());

    const Outcome outcome = run_lamella(command + " --resume");
    REQUIRE(outcome.code == 0);
    auto rest = job_lines(machine.executed());
    REQUIRE(std::equal(first.begin(), first.end(), rest.begin()));
    rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(first.size()));
    // What was executed first is the beginning of the file, up to somewhere in a layer.
    REQUIRE(std::equal(first.begin(), first.end(), file.begin()));
    // The way back: Z is set, never homed; X and Y are homed above the part; then the nozzle is hot.
    const auto position = [&](const std::string& line) {
        return std::find(rest.begin(), rest.end(), line) - rest.begin();
    };
    CHECK(count_of(rest, "G28") == 0);
    CHECK(count_of(rest, "G28 X Y") == 1);
    REQUIRE(position("M109 S210") < static_cast<std::ptrdiff_t>(rest.size()));
    const auto set_z =
        std::find_if(rest.begin(), rest.end(), [](const auto& line) { return line.starts_with("G92 Z"); });
    REQUIRE(set_z != rest.end());
    CHECK(set_z - rest.begin() < position("G28 X Y"));
    CHECK(position("G28 X Y") < position("M109 S210"));
    // Then the file goes on at the beginning of a layer, and no layer is left out: of those that were begun,
    // at most the last ones are made again.
    const auto layer =
        std::find_if(rest.begin(), rest.end(), [](const auto& line) { return line.starts_with("M73 P"); });
    REQUIRE(layer != rest.end());
    const auto in_file = std::find(file.begin(), file.end(), *layer);
    REQUIRE(in_file != file.end());
    CHECK(first_difference({layer, rest.end()}, {in_file, file.end()}) == "");
    const auto begun = static_cast<std::ptrdiff_t>(first.size());
    CHECK(in_file - file.begin() <= begun);
    const auto layers_again = std::count_if(in_file, file.begin() + begun,
                                            [](const auto& line) { return line.starts_with("M73 P"); });
    CHECK(layers_again <= 2);
    // The height that was set is that of the nozzle when the host died.
    std::string height;
    for (const auto& line : first) {
        if (line.starts_with("G0 Z")) height = line.substr(4, line.find(' ', 4) - 4);
    }
    CHECK(*set_z == "G92 Z" + height);
    CHECK(!fs::exists(folder / "journal"));
}

TEST_CASE("Ctrl-C stops a print with heaters and motors off, and it can be taken up") {
    FirmwareOptions firmware;
    firmware.emergency_parser = GENERATE(false, true);
    const Folder folder;
    PtyMachine machine(firmware, 20);
    const std::string command =
        "print " + part + "--port " + machine.path() + " --journal " + folder / "journal";
    const pid_t child = start_lamella(command, folder);
    const bool there = wait_for(30, [&] { return count_of(machine.executed(), "M73 P25") > 0; });
    kill(child, SIGINT);
    const int code = exit_code(child);
    const std::string words = contents(folder / "err");
    INFO(words);
    REQUIRE(there);
    CHECK(code == 130);
    CHECK(mentions(words, "--resume"));
    CHECK(fs::exists(folder / "journal"));
    const auto executed = machine.executed();
    CHECK(!machine.with([](SimulatedMarlin& printer, double) { return printer.heating(); }));
    if (firmware.emergency_parser) {
        CHECK(machine.with([](SimulatedMarlin& printer, double) { return printer.killed(); }));
        CHECK(mentions(words, "M112"));
    } else {
        CHECK(executed.back() == "M84");
        CHECK(count_of(executed, "M104 S0") == 1);
        CHECK(count_of(executed, "M140 S0") == 1);
    }
}

TEST_CASE("a board that resets in mid print stops it, and says where") {
    const Folder folder;
    PtyMachine machine({}, 20);
    const pid_t child = start_lamella(
        "print " + part + "--port " + machine.path() + " --journal " + folder / "journal", folder);
    const bool there = wait_for(30, [&] { return count_of(machine.executed(), "M73 P25") > 0; });
    machine.with([](SimulatedMarlin& printer, double now) { printer.boot(now); });
    const int code = exit_code(child);
    REQUIRE(there);
    const auto at_reset = machine.executed().size();
    CHECK(code == 3);
    const std::string words = contents(folder / "err");
    CHECK(mentions(words, "reset"));
    CHECK(mentions(words, "--resume"));
    // Nothing of the job runs on a board that does not know where it is.
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    CHECK(machine.executed().size() == at_reset);
}

TEST_CASE("a ready file is printed as it is") {
    const Folder folder;
    std::string text = "; a comment\nG28\nG90\nM83\n\n";
    for (int i = 0; i < 1500; ++i) text += "G1 X" + std::to_string(i % 7) + ".500 Y2 E0.01000 F6000 ; move\n";
    write(folder / "ready.gcode", text);
    PtyMachine machine({}, 30);
    REQUIRE(run_lamella("print " + folder / "ready.gcode" + " --greeting 0.2 --port " + machine.path() +
                        " --journal " + folder / "journal")
                .code == 0);
    CHECK(first_difference(job_lines(machine.executed()), clean_lines(folder / "ready.gcode")) == "");
    CHECK(machine.executed().back() == "M105");
}

TEST_CASE("a dry run counts what a print would send") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\nG1 X100 F6000\nG1 X0\n");
    const Outcome outcome = run_lamella("print " + folder / "ready.gcode" + " --dry-run");
    REQUIRE(outcome.code == 0);
    CHECK(mentions(outcome.out, "3 lines"));
    CHECK(mentions(outcome.out, "2 s of motion"));
    write(folder / "marked.gcode", "\xef\xbb\xbfG28\nG1 X100 F6000\nG1 X0\n");  // a byte order mark in front
    const Outcome marked = run_lamella("print " + folder / "marked.gcode" + " --dry-run");
    INFO(marked.err);
    REQUIRE(marked.code == 0);
    CHECK(mentions(marked.out, "3 lines"));
    CHECK(run_lamella("print " + folder / "ready.gcode").code == 2);
    CHECK(run_lamella("print " + folder / "ready.gcode" + " --port /dev/null").code == 2);
    CHECK(run_lamella("print " + folder / "ready.gcode" + " --port /dev/nothing_there").code == 2);
    CHECK(run_lamella("print --shape sphere --shape-radius 3 --printer png --dry-run").code == 2);
}

TEST_CASE("on a terminal p parks, r goes on and s stops, and the terminal is given back") {
    const Folder folder;
    PtyMachine machine({}, 4);
    OnTerminal run("print " + part + "--port " + machine.path() + " --journal " + folder / "journal", folder);
    REQUIRE(wait_for(60, [&] { return run.shows("layer "); }));
    CHECK(run.shows("printer: Marlin 2.1.2.1"));
    CHECK(run.shows("p pause, r resume"));
    run.press('p');
    REQUIRE(wait_for(20, [&] { return run.shows("paused"); }));
    const auto parked = [&] { return machine.executed().back() == "G0 X0 Y220 F6000"; };
    REQUIRE(wait_for(20, parked));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    CHECK(parked());
    run.press('r');
    REQUIRE(wait_for(20, [&] { return count_of(machine.executed(), "M73 P50") > 0; }));
    run.press('s');
    CHECK(run.exit_code() == 130);
    CHECK(run.is_as_it_was());
    CHECK(run.shows("heaters and motors were switched off"));
    CHECK(run.shows("--resume"));
    CHECK(machine.executed().back() == "M84");
    CHECK(fs::exists(folder / "journal"));
    // A line that is drawn again never breaks.
    const std::string& screen = run.screen();
    int drawn = 0;
    for (std::size_t at = screen.find('\r'); at != std::string::npos; at = screen.find('\r', at + 1)) {
        if (screen.compare(at, 2, "\r\n") == 0) continue;
        CHECK(std::min(screen.find('\x1b', at), screen.size()) - at <= 80);
        drawn += screen.compare(at + 4, 2, " %") == 0 ? 1 : 0;
    }
    // Percent and time left come first.
    CHECK(drawn > 3);
    CHECK(mentions(screen, " left  "));
}

TEST_CASE("on a terminal a printer's question is shown, and answered by its key") {
    FirmwareOptions firmware;
    firmware.emergency_parser = firmware.host_prompts = true;
    const Folder folder;
    write(folder / "ready.gcode", "G28\nG90\nM83\nM0\nG1 X5 F6000\n");
    PtyMachine machine(firmware, 10);
    OnTerminal run("print " + folder / "ready.gcode" + " --greeting 0.2 --port " + machine.path() +
                       " --journal " + folder / "journal",
                   folder);
    REQUIRE(wait_for(30, [&] { return run.shows("waits for you: M0 Stop (r: done, 1: Continue)"); }));
    CHECK(count_of(machine.executed(), "M876 S0") == 0);
    run.press('1');
    CHECK(run.exit_code() == 0);
    CHECK(count_of(machine.executed(), "M876 S0") == 1);
    CHECK(job_lines(machine.executed()) == clean_lines(folder / "ready.gcode"));
}

TEST_CASE("a laser's layers are cut over a line, taken up at a layer, and not by a Marlin") {
    const Folder folder;
    const std::string laser =
        "--shape box --shape-size 20,20,24 --layer-height 3 --printer marlin --printer-flavour grbl ";
    REQUIRE(run_lamella("slice " + laser + "-o " + folder / "box.gcode").code == 0);
    const auto file = clean_lines(folder / "box.gcode");
    PtyGrbl machine({}, 1);
    const std::string command =
        "print " + laser + "--greeting 0.2 --port " + machine.path() + " --journal " + folder / "journal";
    CHECK(mentions(run_lamella(command + " --firmware marlin").err, "flavour"));
    const auto start_cycle = [&] {
        machine.with([](SimulatedGrbl& grbl, double) { grbl.held() ? grbl.cycle_start() : void(); });
    };
    const pid_t child = start_lamella(command, folder);
    // The person at the machine lays the next board and presses its button, until the third pause.
    REQUIRE(wait_for(60, [&] {
        if (count_of(machine.executed(), "M0") < 3) start_cycle();
        return count_of(machine.executed(), "M0") == 3 &&
               mentions(contents(folder / "err"), "waits for you: M0");
    }));
    kill(child, SIGINT);
    CHECK(exit_code(child) == 130);
    CHECK(mentions(contents(folder / "err"), "position is kept"));
    const auto first = machine.executed();
    REQUIRE(std::equal(first.begin(), first.end(), file.begin()));

    const pid_t again = start_lamella(command + " --resume", folder);
    int status = 0;
    REQUIRE(wait_for(60, [&] { return start_cycle(), waitpid(again, &status, WNOHANG) == again; }));
    INFO(contents(folder / "err"));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(mentions(contents(folder / "err"), "origin"));
    auto rest = machine.executed();
    rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(first.size()));
    CHECK(rest.back() == "G4 P0.01");
    rest.pop_back();
    // The beam is off first; then the job goes on with the pause before the layer that was not done.
    CHECK(rest.front() == "M5");
    const auto pause = std::find(rest.begin(), rest.end(), "M0");
    REQUIRE(pause != rest.end());
    CHECK(std::find_if(rest.begin(), pause, [](const auto& line) { return line.starts_with("G1 X"); }) ==
          pause);
    REQUIRE(rest.end() - pause <= std::ssize(file));
    CHECK(first_difference({pause, rest.end()}, {file.end() - (rest.end() - pause), file.end()}) == "");
    CHECK(count_of({pause, rest.end()}, "M0") == count_of(file, "M0") - 2);
}

TEST_CASE("a GRBL job that moves in z is not taken up in the midst of it") {
    const Folder folder;
    std::string text = "G21\nG90\nG0 Z5\n";
    for (int i = 0; i < 1500; ++i) text += "G1 X" + std::to_string(i % 9) + " Z-1 F600\n";
    write(folder / "mill.nc", text);
    PtyGrbl machine({}, 1);
    const std::string command = "print " + folder / "mill.nc" + " --firmware grbl --greeting 0.2 --port " +
                                machine.path() + " --journal " + folder / "journal";
    const pid_t child = start_lamella(command, folder);
    const bool there = wait_for(30, [&] { return machine.executed().size() > 900; });
    kill(child, SIGINT);
    CHECK(exit_code(child) == 130);
    REQUIRE(there);
    const Outcome again = run_lamella(command + " --resume");
    CHECK(again.code == 2);
    CHECK(mentions(again.err, "in z"));
}

}  // namespace command_print_test
