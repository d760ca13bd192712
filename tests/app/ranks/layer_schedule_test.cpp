// Who renders what, for ranks that write slowly or quickly.
#include "app/ranks/layer_schedule.h"

#include <algorithm>
#include <catch2/catch.hpp>

namespace layer_schedule_test {

using namespace lamella;

namespace {

/// The owners of layers [0, count), each asked for when rank 0 gets there, and the turns that were told.
struct Plan {
    Plan(int ranks, int count, const WorkTimes& times)
        : turns(ranks, {0, count}, times, [this](Turn turn) { told.push_back(turn); }) {
        for (int layer = 0; layer < count; ++layer) owners.push_back(turns.owner_of(layer));
    }
    std::vector<Turn> told;
    LayerSchedule turns;
    std::vector<int> owners;
};

}  // namespace

TEST_CASE("who is told the turns knows who renders each layer", "[ranks]") {
    for (const int ranks : {1, 2, 3, 7}) {
        for (const double write : {0.0, 0.3, 5.0}) {
            WorkTimes times;
            times.rendering.add(1);
            times.writing.add(write);
            const Plan plan(ranks, 150, times);
            std::vector<int> owners(150, 0);
            int next = 0;
            for (const Turn& turn : plan.told) {
                CHECK(turn.first == next);
                next = turn.end(ranks);
                CHECK(next > turn.first);
                for (int rank = 1; rank < ranks; ++rank) {
                    const LayerRange block = turn.block_of(rank);
                    for (int layer = block.first; layer < std::min(block.last, 150); ++layer)
                        owners[static_cast<std::size_t>(layer)] = rank;
                }
            }
            CHECK(next >= 150);
            CHECK(plan.owners == owners);
        }
    }
}

TEST_CASE("the first rank renders as many layers as leave it time to write all", "[ranks]") {
    WorkTimes times;
    CHECK(!times.fair_share(2));
    times.rendering.add(4);
    CHECK(!times.fair_share(2));
    times.rendering.add(2);  // three seconds a layer
    times.writing.add(1);
    // Four layers rendered, twelve written: as long as eight rendered.
    CHECK(*times.fair_share(2) == Approx(4));
    const auto own_of = [](const Plan& plan) { return std::ranges::count(plan.owners, 0); };
    CHECK(own_of(Plan(2, 1200, times)) == 400);
    CHECK(own_of(Plan(5, 1200, times)) == 0);  // which write three times what they would save
    times.writing.add(0.5);                    // three quarters of a second a layer
    const Plan plan(2, 1200, times);           // 4.8 layers of its own in a turn
    CHECK(own_of(plan) == Approx(1200 * 4.8 / 12.8).margin(8));
    CHECK(own_of(Plan(1, 1200, times)) == 1200);
}

TEST_CASE("turns are told a little ahead, and none behind the last layer", "[ranks]") {
    const WorkTimes times;  // of which nothing is known yet
    std::vector<int> firsts;
    LayerSchedule turns(2, {10, 90}, times, [&](Turn turn) { firsts.push_back(turn.first); });
    CHECK(turns.owner_of(10) == 0);
    CHECK(firsts == std::vector<int>{10, 26, 42});
    CHECK(turns.owner_of(25) == 1);
    CHECK(firsts.size() == 3);
    CHECK(turns.owner_of(26) == 0);
    CHECK(turns.owner_of(89) == 1);
    CHECK(firsts == std::vector<int>{10, 26, 42, 58, 74});
}

}  // namespace layer_schedule_test
