// A print over Klipper's socket: pauses, late layers, faults at any place, and what a later run takes up.
#include <sys/stat.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <random>

#include "engine/base/error.h"
#include "printers/serial/klipper_socket.h"
#include "printers/serial/serial_output.h"
#include "tests/app/commands/mentions.h"
#include "tests/printers/serial/klipper_bench.h"
#include "tests/printers/serial/klipper_on_socket.h"
#include "tests/printers/serial/simulated_firmware.h"
#include "tests/wait_for.h"

namespace klipper_link_test {

using namespace lamella;
using namespace lamella::test;

namespace {

LinkSettings settings_of(const KlipperOnSocket& machine) {
    LinkSettings settings;
    settings.port = machine.path();
    settings.dialect = Dialect::klipper;
    settings.park_x = 5;
    settings.park_y = 200;
    settings.highest = 250;
    return settings;
}

PrintChunk chunk_of(const std::vector<std::string>& lines, int layer) {
    PrintChunk chunk;
    for (const std::string& line : lines) chunk.lines += line + "\n";
    chunk.count = static_cast<std::int64_t>(lines.size());
    chunk.layer = layer;
    return chunk;
}

std::vector<std::string> layer(int index, int count) {
    auto lines = short_moves(count, index * count);
    lines.insert(lines.begin(), "G0 Z" + std::to_string(index + 1) + " F6000");
    return lines;
}

bool has(const std::vector<std::string>& list, const std::string& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

/// A job of small layers, sent as a recipe's job is.
struct Job {
    int layers = 6, lines_a_layer = 40;

    static std::string text(const std::vector<std::string>& lines) {
        std::string text;
        for (const std::string& line : lines) text += line + "\n";
        return text;
    }
    std::vector<std::string> moves() const { return short_moves(layers * lines_a_layer); }
    /// Returns the first layer that is sent.
    int send(GcodeOutput& output, bool resume) const {
        const int first = output.begin({"job", "klipper test", {0, layers}}, resume);
        // Without a layer that is done, the job begins with its header.
        if (!resume) output.commit(text(klipper_start), 0, nullptr);
        for (int index = first; index < layers; ++index)
            output.commit(text(layer(index, lines_a_layer)), index + 1, nullptr);
        output.end("M104 S0\n");
        return first;
    }
};

}  // namespace

TEST_CASE("a print over a socket sends all lines in order, and tells temperatures and layers") {
    KlipperOnSocket machine({}, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    CHECK(link.status().firmware == "Klipper v0.12.0-302-g8f510da");
    auto wanted = klipper_start;
    link.submit(chunk_of(klipper_start, -1));
    for (int index = 0; index < 3; ++index) {
        link.submit(chunk_of(layer(index, 300), index));
        for (const std::string& line : layer(index, 300)) wanted.push_back(line);
    }
    REQUIRE(wait_for(20, [&] { return link.status().layer >= 1; }));
    CHECK(link.status().temperatures.nozzle_target == 200);
    CHECK(link.status().temperatures.nozzle > 190);
    link.finish();
    CHECK(link.status().lines_answered == static_cast<std::int64_t>(wanted.size()));
    auto executed = machine.executed();
    std::erase(executed, "M104 S200");
    std::erase(executed, "M400");
    CHECK(first_difference(executed, wanted) == "");
}

TEST_CASE("a pause parks the nozzle, and a resume brings it back, with no line lost or repeated") {
    KlipperOnSocket machine({}, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    REQUIRE(wait_for(20, [&] { return link.status().lines_answered > 200; }));
    link.pause();
    REQUIRE(wait_for(20, [&] { return has(machine.executed(), "G0 X5 Y200 F6000"); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    CHECK(machine.executed().back() == "G0 X5 Y200 F6000");
    CHECK(link.status().paused);
    link.resume();
    link.finish();
    const auto wanted = layer(0, 2000);
    CHECK(first_difference(moves_of(machine.executed()), {wanted.begin() + 1, wanted.end()}) == "");
}

TEST_CASE("a pause by another program holds the job, and resuming has Klipper resume") {
    KlipperOnSocket machine({}, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    REQUIRE(wait_for(20, [&] { return link.status().lines_answered > 200; }));
    machine.with([](SimulatedKlipper& klippy, double) { klippy.run_of_another("PAUSE"); });
    REQUIRE(wait_for(20, [&] { return link.status().paused; }));
    CHECK(!has(machine.executed(), "G0 X5 Y200 F6000"));
    link.resume();
    link.finish();
    CHECK(has(machine.executed(), "RESUME"));
    CHECK(!has(machine.executed(), "CLEAR_PAUSE"));
    const auto wanted = layer(0, 2000);
    CHECK(first_difference(moves_of(machine.executed()), {wanted.begin() + 1, wanted.end()}) == "");
}

TEST_CASE("a print that is stopped in a pause of Klipper's own leaves none behind") {
    KlipperOnSocket machine({}, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    REQUIRE(wait_for(20, [&] { return link.status().lines_answered > 200; }));
    machine.with([](SimulatedKlipper& klippy, double) { klippy.run_of_another("PAUSE"); });
    REQUIRE(wait_for(20, [&] { return link.status().paused; }));
    link.stop();
    CHECK_THROWS_AS(link.finish(), Interrupted);
    CHECK(machine.executed().back() == "CLEAR_PAUSE");
    CHECK(
        !machine.with([](SimulatedKlipper& klippy, double) { return klippy.paused() || klippy.heating(); }));
}

TEST_CASE("another program's cancellation ends the print with its heaters off") {
    KlipperOnSocket machine({}, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    REQUIRE(wait_for(20, [&] { return link.status().lines_answered > 200; }));
    machine.with([](SimulatedKlipper& klippy, double) { klippy.run_of_another("CANCEL_PRINT"); });
    CHECK_THROWS_AS(link.finish(), Interrupted);
    CHECK(!machine.with([](SimulatedKlipper& klippy, double) { return klippy.heating(); }));
}

TEST_CASE("a stop parks, switches the heaters off and keeps the motors on, also while it heats") {
    KlipperOptions options;
    options.heating_rate = GENERATE(50.0, 0.01);
    KlipperOnSocket machine(options, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 2000), 0));
    const bool heats = options.heating_rate < 1;
    REQUIRE(wait_for(20, [&] {
        return heats ? link.status().line_wait == LineWait::heat : link.status().lines_answered > 200;
    }));
    link.stop();
    CHECK_THROWS_AS(link.finish(), Interrupted);
    CHECK(mentions(link.end_words(), "heaters were switched off"));
    CHECK(!machine.with([](SimulatedKlipper& klippy, double) { return klippy.heating(); }));
    const auto executed = machine.executed();
    CHECK(has(executed, "G0 X5 Y200 F6000") == !heats);
    CHECK(!has(executed, "M84"));
    CHECK(executed.back() == "M400");
}

TEST_CASE("a halt comes before all lines that wait") {
    KlipperOnSocket machine;
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 4000), 0));
    REQUIRE(wait_for(20, [&] { return link.status().lines_answered > 200; }));
    const double before = machine.time();
    link.halt();
    CHECK_THROWS_AS(link.finish(), Interrupted);
    CHECK(mentions(link.end_words(), "FIRMWARE_RESTART"));
    CHECK(machine.with([](SimulatedKlipper& klippy, double) { return klippy.is_shut_down(); }));
    CHECK(machine.with([](SimulatedKlipper& klippy, double) { return klippy.shut_down_at(); }) - before <
          0.3);
}

TEST_CASE("a refused line ends the print with its text, parked and with its heaters off") {
    KlipperOnSocket machine({}, 10);
    PrintLink link(settings_of(machine));
    link.connect();
    const auto lines = layer(0, 2000);
    machine.with([&](SimulatedKlipper& klippy, double) {
        klippy.refuse_next(lines[700], "Move out of range: 1 2 3 [4]");
    });
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(lines, 0));
    std::string words;
    try {
        link.finish();
    } catch (const FaultError& error) {
        words = error.what();
    }
    CHECK(mentions(words, "Move out of range: 1 2 3 [4]"));
    CHECK(mentions(words, "heaters were switched off"));
    CHECK(mentions(words, "were answered"));
    CHECK(!machine.with([](SimulatedKlipper& klippy, double) { return klippy.heating(); }));
    CHECK(has(machine.executed(), "G0 X5 Y200 F6000"));
    CHECK(moves_of(machine.executed()).size() == 699);
}

TEST_CASE("layers that come late are counted, once the machine has done what it had") {
    KlipperOptions options;
    options.look_ahead = 0.5;
    KlipperOnSocket machine(options, 4);
    PrintLink link(settings_of(machine));
    link.connect();
    link.submit(chunk_of(klipper_start, -1));
    link.submit(chunk_of(layer(0, 100), 0));
    REQUIRE(wait_for(20, [&] { return link.status().parked; }));
    link.submit(chunk_of(layer(1, 100), 1));
    link.finish();
    CHECK(link.status().underruns == 1);
    CHECK(link.status().underrun_seconds > 0.4);
    CHECK(has(machine.executed(), "G0 X5 Y200 F6000"));
    CHECK(first_difference(moves_of(machine.executed()), short_moves(200)) == "");
}

TEST_CASE("a socket is used by one print at a time, and says what is wrong with it") {
    KlipperOnSocket machine;
    const MachinePort first = MachinePort::open_socket(machine.path());
    CHECK_THROWS_WITH(MachinePort::open_socket(machine.path()), Catch::Contains("in use by another print"));
    CHECK_THROWS_WITH(MachinePort::open_socket(machine.folder() + "/none"),
                      Catch::Contains("there is no port"));
    std::filesystem::create_directory(machine.folder() + "/folder");
    CHECK_THROWS_WITH(MachinePort::open_socket(machine.folder() + "/folder"),
                      Catch::Contains("is no socket"));
    CHECK_THROWS_AS(MachinePort::open_socket("/tmp/" + std::string(200, 'x')), InputError);
    CHECK(is_socket(machine.path()));
    CHECK(!is_socket(machine.folder()));
}

TEST_CASE("a user who may not open a socket is told who may") {
    KlipperOnSocket machine;
    std::filesystem::permissions(machine.folder(), std::filesystem::perms{0755});
    const bool group = GENERATE(true, false);
    chmod(machine.path().c_str(), group ? 0060 : 0);
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    const pid_t child = fork();
    if (child == 0) {
        constexpr uid_t nobody = 65534;
        std::string text = "opened";
        if (geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) _exit(1);
        try {
            MachinePort::open_socket(machine.path());
        } catch (const InputError& error) {
            text = error.what();
        }
        _exit(write(ends[1], text.data(), text.size()) < 0);
    }
    close(ends[1]);
    char text[1000] = "";
    const ssize_t size = ::read(ends[0], text, sizeof text - 1);
    close(ends[0]);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(status == 0);
    REQUIRE(size > 0);
    CHECK(mentions(text, machine.path() + " may not be opened by this user; it belongs to user "));
    CHECK(mentions(text, group ? ": join that group, or run lamella as " : "only its user may write to it"));
}

TEST_CASE("a resumed print tells its height to a Klipper that has forgotten it, or refuses") {
    KlipperOptions options;
    options.force_move = GENERATE(true, false);
    KlipperOnSocket machine(options, 20);
    LinkSettings settings = settings_of(machine);
    settings.journal = machine.folder() + "/journal";
    const Job job;
    machine.with(
        [&](SimulatedKlipper& klippy, double) { klippy.refuse_next(job.moves()[130], "Move out of range"); });
    const auto send = [&](bool resume) {
        const auto link = std::make_shared<PrintLink>(settings);
        return job.send(*make_serial_output(link, settings, {}), resume);
    };
    CHECK_THROWS_AS(send(false), FaultError);
    REQUIRE(std::filesystem::exists(settings.journal));
    machine.with([](SimulatedKlipper& klippy, double now) { klippy.restart(now); });
    const std::size_t before = machine.executed().size();
    if (!options.force_move) {
        CHECK_THROWS_WITH(send(true), Catch::Contains("enable_force_move"));
        CHECK(std::filesystem::exists(settings.journal));
        return;
    }
    CHECK(send(true) == 3);
    CHECK(!std::filesystem::exists(settings.journal));
    auto rest = machine.executed();
    rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(before));
    const auto height = std::find_if(rest.begin(), rest.end(), [](const std::string& line) {
        return line.starts_with("SET_KINEMATIC_POSITION Z=");
    });
    REQUIRE(height != rest.end());
    CHECK(height < std::find(rest.begin(), rest.end(), "G28 X Y"));
    CHECK(!has(rest, "G28"));
    CHECK(first_difference(moves_of(rest), short_moves(120, 120)) == "");
}

TEST_CASE(
    "whatever fails, each line is executed once and in order, and a later run takes up the first layer "
    "that is not done") {
    enum class Fault { cut, restart, error, shutdown, slow };
    const auto seed = static_cast<unsigned>(GENERATE(range(0, 200)));
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto fault = static_cast<Fault>(random() % 5);
    KlipperOptions options;
    options.look_ahead = 0.2 + static_cast<double>(random() % 4);
    options.old_words = random() % 2 == 0;
    KlipperOnSocket machine(options, 200, seed);
    LinkSettings settings = settings_of(machine);
    settings.journal = machine.folder() + "/journal";
    settings.reconnect_for = 5;
    Job job;
    job.layers = 3 + static_cast<int>(random() % 6);
    job.lines_a_layer = 5 + static_cast<int>(random() % 100);
    const auto moves = job.moves();
    const std::size_t at = random() % moves.size();
    const auto send = [&](bool resume) {
        const auto link = std::make_shared<PrintLink>(settings);
        return job.send(*make_serial_output(link, settings, {}), resume);
    };
    std::thread trouble;
    std::atomic<bool> over{false};
    const auto printed = [&] { return moves_of(machine.executed()).size() > at || over; };
    if (fault == Fault::error)
        machine.with(
            [&](SimulatedKlipper& klippy, double) { klippy.refuse_next(moves[at], "Move out of range"); });
    if (fault == Fault::cut || fault == Fault::restart)
        // The handshake takes some hundred bytes; what comes behind it is the job.
        machine.cut_after(1500 + random() % (30 * moves.size()), fault == Fault::restart);
    if (fault == Fault::shutdown || fault == Fault::slow) {
        trouble = std::thread([&] {
            wait_for(20, printed);
            if (fault == Fault::slow) {
                machine.stand_still(true);
                std::this_thread::sleep_for(std::chrono::milliseconds(30));
                machine.stand_still(false);
            } else {
                machine.with([](SimulatedKlipper& klippy, double now) {
                    klippy.shut_down("MCU 'mcu' shutdown: Timer too close", now);
                });
            }
        });
    }
    std::string words;
    try {
        send(false);
    } catch (const FaultError& error) {
        words = error.what();
    }
    over = true;
    if (trouble.joinable()) trouble.join();
    CAPTURE(words);
    REQUIRE(wait_for(20, [&] {
        return machine.with([](SimulatedKlipper& klippy, double now) { return klippy.idle(now); });
    }));
    const auto first_run = moves_of(machine.executed());
    REQUIRE(first_run.size() <= moves.size());
    REQUIRE(first_difference(first_run, {moves.begin(), moves.begin() + std::ssize(first_run)}) == "");
    if (fault == Fault::slow) CHECK(words.empty());
    if (words.empty()) {
        CHECK(first_run.size() == moves.size());
        CHECK(!std::filesystem::exists(settings.journal));
        return;
    }
    if (fault == Fault::error) {
        CHECK(mentions(words, "Move out of range"));
        CHECK(first_run.size() == at);
        CHECK(!machine.with([](SimulatedKlipper& klippy, double) { return klippy.heating(); }));
    }
    if (fault == Fault::shutdown) CHECK(mentions(words, "Timer too close"));
    if (fault == Fault::cut || fault == Fault::restart) CHECK(mentions(words, "the socket was lost"));
    if (!std::filesystem::exists(settings.journal)) {
        // Nothing was done that could be taken up.
        CHECK(first_run.empty());
        return;
    }
    if (fault == Fault::shutdown)
        machine.with([](SimulatedKlipper& klippy, double now) { klippy.restart(now); });
    const std::size_t before = machine.executed().size();
    const int first = send(true);
    const auto begin = static_cast<std::size_t>(first * job.lines_a_layer);
    // All before it was executed, and nothing of the layer behind it.
    CHECK(begin <= first_run.size());
    CHECK(first_run.size() <= begin + static_cast<std::size_t>(job.lines_a_layer));
    if (fault == Fault::error) CHECK(first == static_cast<int>(at) / job.lines_a_layer);
    auto rest = machine.executed();
    rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(before));
    CHECK(first_difference(moves_of(rest),
                           {moves.begin() + static_cast<std::ptrdiff_t>(begin), moves.end()}) == "");
}

}  // namespace klipper_link_test
