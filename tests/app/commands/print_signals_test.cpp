// `lamella print` when its terminal is closed, when it is stopped and continued, and when nobody reads its
// output.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "printers/serial/gcode_line.h"
#include "tests/app/commands/child_process.h"
#include "tests/app/commands/command_run.h"
#include "tests/printers/serial/pty_machine.h"

namespace print_signals_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// A file of moves that keeps a machine of pace 10 busy for some seconds.
struct Ready {
    Ready() {
        std::string text = "G28\nG90\nM83\nM109 S200\n";
        for (int i = 0; i < 1500; ++i)
            text += "G1 X" + std::to_string(i % 2 * 3) + " E" + std::to_string(i) + " F6000\n";
        write(folder / "ready.gcode", text);
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) lines.push_back(clean_command(line));
    }
    std::string command(const PtyMachine& machine) const {
        return "print " + folder / "ready.gcode" + " --greeting 0.2 --port " + machine.path() +
               " --journal " + folder / "journal";
    }
    bool runs(PtyMachine& machine) const {
        return wait_for(60, [&] { return machine.executed().size() > 200; });
    }
    Folder folder;
    std::vector<std::string> lines;
};

}  // namespace

TEST_CASE("a terminal that is closed ends the view, and the print goes on to its end") {
    const Ready ready;
    PtyMachine machine({}, 10);
    OnTerminal run(ready.command(machine), ready.folder);
    REQUIRE(wait_for(60, [&] { return run.shows(" left") && machine.executed().size() > 200; }));
    run.hang_up();
    CHECK(machine.executed().size() < ready.lines.size());
    CHECK(run.exit_code() == 0);
    CHECK(first_difference(job_lines(machine.executed()), ready.lines) == "");
    CHECK(!fs::exists(ready.folder / "journal"));
}

TEST_CASE("a terminal that is closed stops the print where a flag says so, with heaters and motors off") {
    const Ready ready;
    PtyMachine machine({}, 10);
    OnTerminal run(ready.command(machine) + " --stop-on-hangup", ready.folder);
    REQUIRE(wait_for(60, [&] { return run.shows(" left") && machine.executed().size() > 200; }));
    run.hang_up();
    CHECK(run.exit_code() == 130);
    CHECK(machine.executed().back() == "M84");
    CHECK(!machine.with([](SimulatedMarlin& printer, double) { return printer.heating(); }));
    CHECK(machine.executed().size() < ready.lines.size());
}

TEST_CASE("neither repeated hang-ups, Ctrl-Z, nor a stop and a continue spoil a print") {
    const Ready ready;
    PtyMachine machine({}, 10);
    const pid_t child = start_lamella(ready.command(machine), ready.folder);
    REQUIRE(ready.runs(machine));
    SECTION("hang-ups, as a shell and the kernel send them") {
        for (int i = 0; i < 5; ++i) kill(child, SIGHUP), kill(child, SIGCONT);
    }
    SECTION("Ctrl-Z") {
        kill(child, SIGTSTP);
        int status = 0;
        CHECK(!wait_for(0.5, [&] { return waitpid(child, &status, WNOHANG | WUNTRACED) == child; }));
        CHECK(wait_for(5, [&] { return mentions(contents(ready.folder / "err"), "Ctrl-Z does not stop"); }));
    }
    SECTION("stopped for ten seconds of the printer's time") {
        machine.with([](SimulatedMarlin& printer, double) { printer.say("echo:busy: processing"); });
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        kill(child, SIGSTOP);
        std::this_thread::sleep_for(std::chrono::seconds(1));
        kill(child, SIGCONT);
    }
    CHECK(exit_code(child) == 0);
    CHECK(first_difference(job_lines(machine.executed()), ready.lines) == "");
    CHECK(mentions(contents(ready.folder / "err"), "0 timeouts"));
}

TEST_CASE("a print in the background of its terminal is not stopped by it") {
    const Ready ready;
    PtyMachine machine({}, 20);
    // With job control a background job that changes the terminal's mode, reads it, or under tostop writes to
    // it, is stopped.
    OnTerminal run("set -m; stty tostop; env " +
                   command_line(ready.command(machine), ready.folder / "cache") +
                   " & wait $!; code=$?; "
                   "stty -tostop; echo code=$code; exit $code");
    CHECK(run.exit_code() == 0);
    CHECK(run.shows("code=0"));
    CHECK(first_difference(job_lines(machine.executed()), ready.lines) == "");
}

TEST_CASE("a print whose output nobody reads goes on") {
    const Ready ready;
    PtyMachine machine({}, 20);
    const std::string line = "{ env " + command_line(ready.command(machine), ready.folder / "cache") +
                             " </dev/null; echo $? >" + ready.folder / "code" + "; } 2>&1 | true";
    const pid_t child = start_shell(line);
    exit_code(child);
    REQUIRE(wait_for(60, [&] { return contents(ready.folder / "code") == "0\n"; }));
    CHECK(first_difference(job_lines(machine.executed()), ready.lines) == "");
}

TEST_CASE("M0 without keys says once what to do, and USR1 does it") {
    const Folder folder;
    write(folder / "ready.gcode", "G28\nG90\nM0 NUT\nG1 X5 F6000\n");
    PtyMachine machine({}, 10);
    const pid_t child = start_lamella("print " + folder / "ready.gcode" + " -q --greeting 0.2 --port " +
                                          machine.path() + " --journal " + folder / "journal",
                                      folder);
    const std::string words = "kill -USR1 " + std::to_string(child);
    REQUIRE(wait_for(30, [&] { return mentions(contents(folder / "err"), words); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const std::string said = contents(folder / "err");
    CHECK(said.find(words) == said.rfind(words));
    CHECK(mentions(said, "M0 NUT"));
    kill(child, SIGUSR1);
    CHECK(exit_code(child) == 0);
    CHECK(count_of(machine.executed(), "G1 X5 F6000") == 1);
}

TEST_CASE("other commands end by a hang-up as by a termination, unless they are to ignore it") {
    const Folder folder;
    const std::string slow =
        "slice --shape sphere --shape-radius 20 --layer-height 0.002 --cell 3 --beam 0.5 -o " +
        folder / "out" + " --printer png";
    const auto begun = [&] { return fs::exists(folder / "out.partial/00001.png"); };
    const bool ignores = GENERATE(false, true);
    signal(SIGHUP, SIG_DFL);  // the tests themselves may run under nohup
    const pid_t child =
        start_shell((ignores ? "trap '' HUP; exec env " : "exec env ") +
                    command_line(slow, folder / "cache") + " >" + folder / "log" + " 2>&1 </dev/null");
    REQUIRE(wait_for(60, begun));
    kill(child, SIGHUP);
    if (ignores) {
        int status = 0;
        CHECK(!wait_for(1, [&] { return waitpid(child, &status, WNOHANG) == child; }));
        kill(child, SIGTERM);
    }
    CHECK(exit_code(child) == 130);
    CHECK(mentions(contents(folder / "log"), "--resume"));
}

}  // namespace print_signals_test
