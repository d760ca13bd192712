// Lines a second over a serial line: against a simulated AVR at the wire's speed, against one that answers at
// once, and through a pseudo-terminal with the thread that owns the port.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include "printers/serial/serial_output.h"
#include "tests/printers/serial/marlin_bench.h"

namespace {

using namespace lamella;
using namespace lamella::test;

/// Short segments, faster than an AVR can take them: it needs some 5 ms a line. Simulated time.
void serial_segments(benchmark::State& state) {
    const bool ping_pong = state.range(0) != 0;
    const double latency = static_cast<double>(state.range(1)) / 1000;
    std::vector<std::string> lines;
    for (int i = 0; i < 1000; ++i)
        lines.push_back("G1 X000." + std::to_string(i % 2) + "23 Y00.765 E0.0" + std::to_string(1000 + i));
    double seconds = 0;
    for (auto _ : state) {
        FirmwareOptions firmware;
        firmware.old = true;
        firmware.line_time = 0.005;
        SenderSettings settings;
        settings.ping_pong = ping_pong;
        MarlinBench bench(firmware, settings, {}, {}, 1, latency);
        bench.run(10, [&] { return bench.sender.connected(); });
        const double start = bench.now;
        if (!bench.print(lines, 100) || bench.printer.errors() > 0) state.SkipWithError("the print failed");
        seconds = bench.now - start;
    }
    state.counters["lines_per_s"] = 1000 / seconds;
}
BENCHMARK(serial_segments)
    ->ArgNames({"ping_pong", "latency_ms"})
    ->ArgsProduct({{1, 0}, {0, 4}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// The sender alone, against a machine that answers at once.
void serial_sender(benchmark::State& state) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += "G1 X" + std::to_string(i % 200) + ".125 Y98.765 E0.01234\n";
    DryRun report;
    for (auto _ : state) {
        const auto output = make_dry_run({}, report);
        output->begin({"", "", {0, 1}}, false);
        output->commit(text, 1, nullptr);
        output->end("");
    }
    state.counters["lines_per_s"] = static_cast<double>(report.lines) / report.sending_seconds;
}
BENCHMARK(serial_sender)->Iterations(1)->Unit(benchmark::kMillisecond);

/// A machine behind a pseudo-terminal that answers at once, and notes how soon the next line comes.
class InstantMachine {
  public:
    InstantMachine() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
        grantpt(master_);
        unlockpt(master_);
        char name[128];
        ptsname_r(master_, name, sizeof name);
        path = name;
        slave_ = open(name, O_RDWR | O_NOCTTY);
        termios mode{};
        tcgetattr(slave_, &mode);
        cfmakeraw(&mode);
        tcsetattr(slave_, TCSANOW, &mode);
        thread_ = std::thread([this] { work(); });
    }
    ~InstantMachine() {
        ending_ = true;
        thread_.join();
        close(slave_);
        close(master_);
    }
    std::string path;
    std::vector<double> waits;  ///< s from an ok to the next bytes

  private:
    void work() {
        std::string line;
        auto answered = std::chrono::steady_clock::now();
        while (!ending_) {
            pollfd watched{master_, POLLIN, 0};
            if (poll(&watched, 1, 10) <= 0) continue;
            char buffer[4096];
            const ssize_t got = read(master_, buffer, sizeof buffer);
            waits.push_back(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - answered).count());
            std::string said;
            for (ssize_t i = 0; i < got; ++i) {
                if (buffer[i] != '\n') {
                    line += buffer[i];
                    continue;
                }
                if (line.find("M115") != std::string::npos) said += "FIRMWARE_NAME:Marlin\n";
                said += line.find(" M105*") != std::string::npos ? "ok T:0 /0\n" : "ok\n";
                line.clear();
            }
            if (!said.empty() && write(master_, said.data(), said.size()) < 0) return;
            answered = std::chrono::steady_clock::now();
        }
    }
    int master_;
    int slave_ = -1;
    std::atomic<bool> ending_{false};
    std::thread thread_;
};

void serial_port(benchmark::State& state) {
    constexpr std::int64_t count = 100000;
    for (auto _ : state) {
        InstantMachine machine;
        LinkSettings settings;
        settings.port = machine.path;
        settings.sender.greeting = 0;
        settings.sender.ping_pong = state.range(0) != 0;
        PrintLink link(settings);
        link.connect();
        PrintChunk chunk;
        for (int i = 0; i < count; ++i)
            chunk.lines += "G1 X" + std::to_string(i % 200) + ".125 Y98.765 E0.01234\n";
        chunk.count = count;
        const auto start = std::chrono::steady_clock::now();
        link.submit(std::move(chunk));
        link.finish();
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        state.counters["lines_per_s"] = count / seconds;
        std::vector<double>& waits = machine.waits;
        std::sort(waits.begin(), waits.end());
        state.counters["p50_us"] = waits[waits.size() / 2] * 1e6;
        state.counters["p99_us"] = waits[waits.size() * 99 / 100] * 1e6;
    }
}
BENCHMARK(serial_port)
    ->ArgNames({"ping_pong"})
    ->Arg(0)
    ->Arg(1)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
