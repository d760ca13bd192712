// Queries of an interval index against a look at every interval.
#include "engine/runs/interval_index.h"

#include <catch2/catch.hpp>
#include <random>

namespace interval_index_test {

using namespace lamella;

namespace {

std::vector<std::uint32_t> found(const IntervalIndex& index, const Interval& wanted) {
    std::vector<std::uint32_t> items;
    index.query(wanted, items);
    return items;
}

}  // namespace

TEST_CASE("an interval index finds what a look at every interval finds", "[runs]") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-10, 10), width(0, 3);
    std::vector<Interval> intervals;
    for (int i = 0; i < 200; ++i) {
        const double lo = place(random);
        intervals.push_back({lo, lo + width(random)});
    }
    const IntervalIndex index(intervals, std::vector<double>(intervals.size(), 0.0));
    for (int i = 0; i < 200; ++i) {
        const double lo = place(random);
        const Interval wanted{lo, lo + width(random)};
        std::vector<std::uint32_t> expected;
        for (std::uint32_t k = 0; k < intervals.size(); ++k) {
            if (intervals[k].lo <= wanted.hi && wanted.lo <= intervals[k].hi) expected.push_back(k);
        }
        CHECK(found(index, wanted) == expected);
    }
}

TEST_CASE("an interval index of tiny extent answers queries from far away", "[runs]") {
    const std::vector<Interval> tiny{{0, 1e-28}, {1e-28, 3e-28}, {0, 5e-324}};
    const IntervalIndex index(tiny, {0, 1, 2});
    CHECK(found(index, {-1e9, 1e9}) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(found(index, {0, 1}) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(found(index, {1e-3, 1e9}).empty());
    const IntervalIndex least({{0, 5e-324}}, {0});
    CHECK(found(least, {0, 1e9}) == std::vector<std::uint32_t>{0});
}

}  // namespace interval_index_test
