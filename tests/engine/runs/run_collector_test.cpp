// Merged runs against a line of bits.
#include "engine/runs/run_collector.h"

#include <catch2/catch.hpp>
#include <random>

namespace run_collector_test {

using namespace lamella;

TEST_CASE("runs that overlap, touch, miss and stick out merge to what bits say") {
    std::mt19937 random(17);
    const auto number = [&](int least, int most) {
        return least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1));
    };
    RunCollector collector;  // one for all, as bands share it
    for (int trial = 0; trial < 300; ++trial) {
        RowBand band;
        band.count = number(1, 9);
        band.sub = number(1, 3);
        band.lo = number(-1, 0);
        band.hi = band.lo + number(1, 2);
        constexpr std::int32_t least = -2 * run_unit, most = 4 * run_unit;
        const int lines = band.lines();
        std::vector<std::vector<bool>> bits(static_cast<std::size_t>(lines), std::vector<bool>(most - least));
        collector.clear();
        const int pieces = number(0, 40), longest = number(1, 200);
        for (int p = 0; p < pieces; ++p) {
            const int first = number(0, lines - 1), count = number(0, lines - first);
            const auto segment = collector.add(first, count);
            for (int i = 0; i < count; ++i) {
                const std::int32_t begin = number(least, most - 200), end = begin + number(-2, longest);
                segment.begin[i] = begin;
                segment.end[i] = end;
                const std::int32_t lo = std::max(begin, band.lo * run_unit),
                                   hi = std::min(end, band.hi * run_unit);
                const auto line = static_cast<std::size_t>(first) + static_cast<std::size_t>(i);
                for (std::int32_t u = lo; u < hi; ++u) bits[line][static_cast<std::size_t>(u - least)] = true;
            }
        }
        RunRows rows;
        collector.merge(band, rows);
        REQUIRE(rows.lines() == static_cast<std::size_t>(lines));
        for (std::size_t l = 0; l < rows.lines(); ++l) {
            std::vector<Run> expected;
            for (std::int32_t u = least; u < most; ++u) {
                if (!bits[l][static_cast<std::size_t>(u - least)]) continue;
                if (!expected.empty() && expected.back().end == u) {
                    ++expected.back().end;
                } else {
                    expected.push_back({u, u + 1});
                }
            }
            const auto got = rows.line(l);
            REQUIRE(std::vector<Run>(got.begin(), got.end()) == expected);
        }
    }
}

}  // namespace run_collector_test
