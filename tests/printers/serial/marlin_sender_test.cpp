// The Marlin sender against a simulated printer: what was executed is the judge.
#include "printers/serial/marlin_sender.h"

#include <catch2/catch.hpp>

#include "tests/printers/serial/faulty_wire.h"
#include "tests/printers/serial/simulated_firmware.h"

using namespace lamella;
using namespace lamella::test;

namespace {

/// Moves that take `duration` seconds each, all different.
std::vector<std::string> moves(int count, double duration = 0) {
    std::vector<std::string> lines;
    for (int i = 0; i < count; ++i) {
        const double way = duration > 0 ? duration * 100 : 0;
        lines.push_back("G1 X" + std::to_string(i % 2 == 0 ? static_cast<int>(way) : 0) + " E" +
                        std::to_string(i) + " F6000");
    }
    return lines;
}

/// A sender, a printer and two wires, moved on by small steps of time.
struct Bench {
    explicit Bench(FirmwareOptions options, SenderSettings settings = {}, WireFaults to = {},
                   WireFaults from = {}, unsigned seed = 1, double latency = 0.001)
        : sender(settings, {}),
          printer(options),
          out(to, latency, 10.0 / 250000, seed),
          in(from, latency, 10.0 / 250000, seed + 1000) {
        printer.boot(0);
        sender.connect(0);
    }
    void step() {
        now += 0.00025;
        sender.tick(now);
        const std::string bytes(sender.output());
        sender.wrote(bytes.size());
        most_unanswered = std::max(most_unanswered, sender.unanswered());
        if (!unplugged) out.put(bytes, now);
        printer.receive(out.take(now), now);
        const std::string said = printer.run(now);
        if (!unplugged) in.put(said, now);
        sender.receive(in.take(now), now);
    }
    template <class Until>
    bool run(double seconds, Until until) {
        for (const double end = now + seconds; now < end;) {
            step();
            if (until()) return true;
        }
        return false;
    }
    bool print(const std::vector<std::string>& lines, double seconds) {
        for (const std::string& line : lines) sender.push(line);
        sender.finish();
        return run(seconds, [&] { return sender.finished() || sender.stopped(); });
    }

    MarlinSender sender;
    SimulatedMarlin printer;
    FaultyWire out, in;
    double now = 0;
    bool unplugged = false;
    std::size_t most_unanswered = 0;
};

}  // namespace

TEST_CASE("without faults every line is executed once, none is asked for twice, and no byte is lost") {
    FirmwareOptions options;
    options.old = GENERATE(false, true);
    options.advanced_ok = GENERATE(false, true);
    SenderSettings settings;
    settings.window = GENERATE(64, 127);
    Bench bench(options, settings);
    const auto lines = moves(3000, 0.004);
    REQUIRE(bench.print(lines, 100));
    CHECK(!bench.sender.stopped());
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK(bench.sender.answered() == 3000);
    CHECK(bench.printer.errors() == 0);
    CHECK(bench.printer.lost_bytes() == 0);
    CHECK(bench.sender.statistics().resends == 0);
    CHECK(bench.sender.statistics().timeouts == 0);
    CHECK(bench.most_unanswered <= settings.window);
    CHECK(bench.most_unanswered > settings.window / 2);
}

TEST_CASE("ten thousand lines get through one per cent of every fault, once each and in order") {
    const unsigned seed = GENERATE(range(1U, 17U));
    FirmwareOptions options;
    options.old = seed % 2 == 0;
    options.advanced_ok = seed % 4 >= 2;
    options.spurious = 0.01;
    options.seed = seed;
    const WireFaults to{0.01, 0.01, 0.01, 0.01, 0, 0.01};
    const WireFaults from{0.0, 0.0, 0.0, 0.01, 0.01, 0.0};
    Bench bench(options, {}, to, from, seed);
    const auto lines = moves(10000);
    INFO("seed " << seed);
    REQUIRE(bench.print(lines, 5 * 900));
    INFO(bench.now << " s, " << bench.sender.statistics().resends << " resends, "
                   << bench.sender.statistics().timeouts << " timeouts");
    if (bench.sender.stopped()) FAIL(bench.sender.stopped()->why);
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK(bench.sender.answered() == 10000);
    CHECK(bench.out.faults() > 300);
    // No fault costs more than five seconds, most far less.
    CHECK(bench.now < 10 + 5.0 * (bench.in.faults() + bench.out.faults() + 100));
    INFO("seed " << seed << ": " << bench.now << " s, " << bench.sender.statistics().resends << " resends, "
                 << bench.sender.statistics().timeouts << " timeouts, faults " << bench.out.faults() << " "
                 << bench.in.faults());
}

TEST_CASE("spoilt replies end in the whole job or in a plain stop, never in a wrong one") {
    const unsigned seed = GENERATE(range(1U, 13U));
    FirmwareOptions options;
    options.old = seed % 2 == 0;
    options.seed = seed;
    const WireFaults from{0.01, 0.01, 0.01, 0.01, 0.01, 0.01};
    Bench bench(options, {}, {0.005, 0.005, 0.005, 0.005, 0, 0.005}, from, seed);
    const auto lines = moves(5000);
    INFO("seed " << seed);
    REQUIRE(bench.print(lines, 5000));
    const auto executed = job_lines(bench.printer.executed());
    if (bench.sender.stopped()) {
        WARN("seed " << seed << ": " << bench.sender.stopped()->why);
        CHECK(!bench.sender.stopped()->why.empty());
        REQUIRE(executed.size() <= lines.size());
        CHECK(std::equal(executed.begin(), executed.end(), lines.begin()));
    } else {
        CHECK(first_difference(executed, lines) == "");
    }
}
