// The Marlin sender against a simulated printer: what was executed is the judge.
#include <catch2/catch.hpp>

#include "tests/printers/serial/marlin_bench.h"

namespace marlin_sender_test {

using namespace lamella;
using namespace lamella::test;

TEST_CASE("without faults every line is executed once, none is asked for twice, and no byte is lost") {
    FirmwareOptions options;
    options.old = GENERATE(false, true);
    options.advanced_ok = GENERATE(false, true);
    SenderSettings settings;
    settings.window = GENERATE(64, 127);
    MarlinBench bench(options, settings);
    const auto lines = moves(3000, 0.004);
    REQUIRE(bench.print(lines, 100));
    CHECK(!bench.sender.stopped());
    CHECK(first_difference(job_lines(bench.printer.executed()), lines) == "");
    CHECK(bench.sender.answered() == 3000);
    CHECK(bench.printer.errors() == 0);
    CHECK(bench.printer.lost_bytes() == 0);
    CHECK(bench.sender.statistics().resends == 0);
    CHECK(bench.sender.statistics().timeouts == 0);
    CHECK(bench.max_unanswered <= settings.window);
    CHECK(bench.max_unanswered > settings.window / 2);
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
    MarlinBench bench(options, {}, to, from, seed);
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
    MarlinBench bench(options, {}, {0.005, 0.005, 0.005, 0.005, 0, 0.005}, from, seed);
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

}  // namespace marlin_sender_test
