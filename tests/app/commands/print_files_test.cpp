// `lamella print` with files that are empty, wrong, or for a machine that acts on single characters.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "tests/app/commands/child_process.h"
#include "tests/app/commands/command_run.h"
#include "tests/printers/serial/pty_machine.h"

namespace print_files_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

TEST_CASE("resuming without a journal prints nothing, and names the journal that is missing") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\nG90\nG1 X5 F6000\n");
    PtyMachine machine({}, 10);
    const std::string command = "print " + folder / "ready.gcode" + " --greeting 0.2 --port " +
                                machine.path() + " --journal " + folder / "gone.journal";
    const Outcome ready = run_lamella(command + " --resume");
    CHECK(ready.code == 2);
    CHECK(mentions(ready.err, "gone.journal"));
    CHECK(mentions(ready.err, "--resume"));
    const Outcome recipe = run_lamella(
        "print --shape sphere --shape-radius 2.5 --layer-height 0.25 --printer marlin --greeting 0.2 "
        "--port " +
        machine.path() + " --journal " + folder / "gone.journal" + " --resume");
    CHECK(recipe.code == 2);
    CHECK(mentions(recipe.err, "gone.journal"));
    CHECK(machine.executed().empty());
    // A height without --resume would be left out of account.
    const Outcome height = run_lamella(command + " --resume-z 3");
    CHECK(height.code == 2);
    CHECK(mentions(height.err, "--resume"));
    CHECK(machine.executed().empty());
}

TEST_CASE("a print that is stopped before anything can be taken up does not promise --resume") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\nM0\nG1 X5 F6000\n");
    PtyMachine machine({}, 10);
    const pid_t child = start_lamella("print " + folder / "ready.gcode" + " --greeting 0.2 --port " +
                                          machine.path() + " --journal " + folder / "journal",
                                      folder);
    REQUIRE(wait_for(30, [&] { return mentions(contents(folder / "err"), "waits for you"); }));
    kill(child, SIGINT);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WEXITSTATUS(status) == 130);
    CHECK(!fs::exists(folder / "journal"));
    CHECK(!mentions(contents(folder / "err"), "--resume"));
}

TEST_CASE("a file without a line to send is no job") {
    const Folder folder;
    PtyMachine machine({}, 10);
    for (const char* text : {"", "\n\n", "; only\n(comments)\n", "%\n"}) {
        write(folder / "empty.gcode", text);
        for (const std::string& target : {"--port " + machine.path(), std::string("--dry-run")}) {
            const Outcome outcome =
                run_lamella("print " + folder / "empty.gcode" + " --greeting 0.2 " + target);
            CHECK(outcome.code == 2);
            CHECK(mentions(outcome.err, "empty.gcode"));
            CHECK(mentions(outcome.err, "no line to send"));
        }
    }
    CHECK(machine.executed().empty());
}

TEST_CASE("a line that cannot be sent is told by its number, before anything is sent") {
    const Folder folder;
    const auto [line, words] = GENERATE(table<std::string, std::string>(
        {{"@pause", "command to a host"}, {"hello \xC3\xA4", "no ASCII"}, {"1 2 3", "no G-code"}}));
    std::string text = "; comment\nG28\n";
    for (int i = 0; i < 1200; ++i)
        text += i % 3 == 0 ? "; comment\n" : "G1 X" + std::to_string(i) + " F6000\n";
    write(folder / "ready.gcode", text + line + "\nG1 X0\n");
    PtyMachine machine({}, 10);
    const Outcome outcome = run_lamella("print " + folder / "ready.gcode" + " --port " + machine.path());
    CHECK(outcome.code == 2);
    CHECK(mentions(outcome.err, "ready.gcode, line 1203: "));
    CHECK(mentions(outcome.err, words));
    CHECK(machine.executed().empty());
}

TEST_CASE("GRBL gets no hold, no start and no request for its state from a comment or a text") {
    const Folder folder;
    write(folder / "job.nc", "G21\nG90\nG1 X10 Y10 F600 ; now!\nM0 (next sheet! ready?)\nG1 X0 ~\n");
    PtyGrbl machine({}, 1);
    const std::string command = "print " + folder / "job.nc" + " --firmware grbl --greeting 0.2 --log " +
                                folder / "log" + " --journal " + folder / "journal --port " + machine.path();
    // In a command they are no G-code.
    const Outcome refused = run_lamella(command);
    CHECK(refused.code == 2);
    CHECK(mentions(refused.err, "job.nc, line 5: "));
    CHECK(machine.executed().empty());

    write(folder / "job.nc", "G21\nG90\nG1 X10 Y10 F600 ; now!\nM0 (next sheet! ready?)\nG1 X0\n");
    const pid_t child = start_lamella(command, folder);
    REQUIRE(wait_for(30, [&] { return mentions(contents(folder / "err"), "waits for you: M0"); }));
    CHECK(
        machine.with([](SimulatedGrbl& grbl, double) { return grbl.holds == 0 && grbl.cycle_starts == 0; }));
    machine.with([](SimulatedGrbl& grbl, double) { grbl.cycle_start(); });
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(machine.executed() ==
          std::vector<std::string>{"G21", "G90", "G1 X10 Y10 F600", "M0", "G1 X0", "G4 P0.01"});
    CHECK(
        machine.with([](SimulatedGrbl& grbl, double) { return grbl.holds == 0 && grbl.cycle_starts == 0; }));
    CHECK(mentions(contents(folder / "err"), "printer: Grbl 1.1h, up to 127 bytes ahead"));
    CHECK(!mentions(contents(folder / "err"), "nozzle"));
}

TEST_CASE(
    "a script for GRBL with a character on which it acts is refused, and no name brings one into the file") {
    const Folder folder;
    const std::string laser = "slice --shape box --shape-size 10,10,8 --layer-height 4 --printer grbl-laser ";
    for (const char* script : {"M0 (put in the next board! ready?)", "G4 P1 ~"}) {
        const Outcome outcome =
            run_lamella(laser + "-o " + folder / "laser.gcode" + " --printer-layer-script '" + script + "'");
        CHECK(outcome.code == 2);
        CHECK(mentions(outcome.err, "--printer-layer-script"));
        CHECK(mentions(outcome.err, "line 1"));
    }
    // Other firmware shows them.
    CHECK(run_lamella("slice --shape box --shape-size 10,10,2 --layer-height 0.25 --printer marlin -o " +
                      folder / "marlin.gcode" + " --printer-layer-script 'M117 ready?'")
              .code == 0);
    write(
        folder / "name.toml",
        "[part]\nname = \"B\xC3\xBCgel! ready?\"\nshape = \"box\"\nsize = [10, 10, 8]\n[layers]\nheight = 4\n"
        "[printer]\nprofile = \"grbl-laser\"\n");
    REQUIRE(run_lamella("slice " + folder / "name.toml" + " -o " + folder / "laser.gcode").code == 0);
    const std::string text = contents(folder / "laser.gcode");
    CHECK(mentions(text, "; job: "));
    CHECK(text.find_first_of("!~?") == std::string::npos);
}

TEST_CASE("a dry run writes the log that it is asked for, and says when it cannot") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\nG1 X100 F6000\nG1 X0\n");
    REQUIRE(run_lamella("print " + folder / "ready.gcode" + " --dry-run --log " + folder / "log").code == 0);
    CHECK(mentions(contents(folder / "log"), "G1 X100 F6000*"));
    CHECK(mentions(contents(folder / "log"), "< "));
    const Outcome full = run_lamella("print " + folder / "ready.gcode" + " --dry-run --log /dev/full");
    CHECK(full.code == 3);
    CHECK(mentions(full.err, "No space left"));
}

TEST_CASE("what is waited for is said at once") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\n");
    PtyMachine machine({}, 10);
    machine.stand_still(true);
    const pid_t child = start_lamella(
        "print " + folder / "ready.gcode" + " --port " + machine.path() + " --baud 115200", folder);
    CHECK(wait_for(3, [&] {
        return mentions(contents(folder / "err"),
                        "waiting for the printer at " + machine.path() + ", 115200 baud");
    }));
    machine.with([](SimulatedMarlin& printer, double) { printer.say("\x80\xF0\x03\xFE\x80\x1F\x80\x01"); });
    machine.stand_still(false);
    CHECK(wait_for(3, [&] { return mentions(contents(folder / "err"), "no text: try --baud 250000"); }));
    kill(child, SIGINT);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(WEXITSTATUS(status) == 130);
}

}  // namespace print_files_test
