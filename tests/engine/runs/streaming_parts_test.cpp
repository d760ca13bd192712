// Parts that pass by: as large and as joined as those of a solid that is kept, whatever is forgotten.
#include "engine/runs/streaming_parts.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>

namespace streaming_parts_test {

using namespace lamella;

namespace {

RunRows random_layer(std::mt19937& random, double density) {
    std::uniform_real_distribution<double> draw(0, 1);
    RunRows layer;
    for (int r = 0; r < 12; ++r) {
        for (int c = 0; c < 16; ++c) {
            if (draw(random) < density) layer.push(c * 10, c * 10 + 4 + static_cast<int>(3 * draw(random)));
        }
        layer.end_line();
    }
    return layer;
}

}  // namespace

TEST_CASE("parts that pass by are those of the whole, and what is not used can be forgotten",
          "[components]") {
    for (const double density : {0.05, 0.1, 0.2}) {
        std::mt19937 random(static_cast<unsigned>(1000 * density));
        RunComponents whole(Growth{}, 0);
        StreamingParts passing;
        std::map<std::uint32_t, std::uint32_t>
            used;  // a number of the one, and that of the same part in the other
        for (int l = 0; l < 60; ++l) {
            const LabelledLayer labelled = label_layer(random_layer(random, density), l, Growth{});
            const std::vector<std::uint32_t> numbers = whole.add(labelled, l);
            const LabelledLayer& placed = passing.add(labelled);
            for (std::size_t i = 0; i < labelled.runs.size(); i += 7)
                used[placed.runs[i].component] = numbers[labelled.runs[i].component];
            if (l % 5 == 4) {
                std::vector<std::uint32_t> kept;
                kept.reserve(used.size());
                for (const auto& [number, same] : used) kept.push_back(number);
                passing.forget_all_but(kept);
                CHECK(passing.size() <= 2 * kept.size() + labelled.runs.size());
            }
        }
        std::map<std::uint32_t, std::uint32_t> known;
        for (const auto& [number, same] : used) {
            CHECK(passing.length(number) == whole.component(same).extent.length);
            const auto [pair, fresh] = known.emplace(passing.find(number), whole.find(same));
            CHECK(pair->second == whole.find(same));
        }
        std::map<std::uint32_t, std::uint32_t> back;
        for (const auto& [mine, theirs] : known) CHECK(back.emplace(theirs, mine).second);
    }
}

}  // namespace streaming_parts_test
