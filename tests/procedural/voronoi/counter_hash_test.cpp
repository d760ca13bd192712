// The counter hash: sensitive to every argument, uniform, and the published finaliser.
#include "procedural/voronoi/counter_hash.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>

namespace counter_hash_test {

using namespace lamella;

TEST_CASE("every argument of the counter hash changes the number", "[counter_hash]") {
    std::set<std::uint64_t> seen;
    for (std::uint64_t seed : {0U, 1U})
        for (int level : {0, 1})
            for (int x : {-1, 0, 1})
                for (int y : {-1, 0, 1})
                    for (int z : {-1, 0, 1})
                        for (std::uint64_t draw : {0U, 1U, 2U})
                            seen.insert(CounterHash(seed, level, x, y, z).bits(draw));
    CHECK(seen.size() == 2 * 2 * 27 * 3);
}

TEST_CASE("the mixing step is SplitMix64's", "[counter_hash]") {
    // The first two outputs of the reference generator started at 0.
    CHECK(mix(0x9e3779b97f4a7c15ULL) == 0xe220a8397b1dcdafULL);
    CHECK(mix(2 * 0x9e3779b97f4a7c15ULL) == 0x6e789e6aa1b965f4ULL);
}

TEST_CASE("uniform draws are uniform and never 0 or 1", "[counter_hash]") {
    std::array<int, 10> bins{};
    for (int i = 0; i < 100000; ++i) {
        const double u = CounterHash(5, 3, i, 7, -i).uniform(2);
        REQUIRE((u > 0 && u < 1));
        ++bins[static_cast<std::size_t>(u * 10)];
    }
    // Six standard deviations of a bin's count of 10,000.
    for (const int count : bins) CHECK(std::abs(count - 10000) < 570);
}

}  // namespace counter_hash_test
