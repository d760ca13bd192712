// Components that pass by: the same as those of a solid that is kept, each told of once it has ended.
#include "engine/runs/streaming_components.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

namespace streaming_components_test {

using namespace lamella;

namespace {

constexpr int layers = 40, rows = 12, columns = 16;

std::vector<RunRows> random_stack(unsigned seed, double density) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> draw(0, 1);
    std::vector<RunRows> stack(layers);
    for (RunRows& layer : stack) {
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (draw(random) < density)
                    layer.push(c * 10, c * 10 + 4 + static_cast<int>(3 * draw(random)));
            }
            layer.end_line();
        }
    }
    return stack;
}

std::vector<std::vector<std::int64_t>> sorted(std::vector<std::vector<std::int64_t>> list) {
    std::ranges::sort(list);
    return list;
}

std::vector<std::int64_t> numbers_of(const ComponentExtent& e) {
    return {e.length, e.along.begin, e.along.end, e.first_row, e.last_row, e.first_layer, e.last_layer};
}

RunRows drawn(const std::vector<std::string>& lines) {
    RunRows out;
    for (const std::string& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] == '#') out.push(static_cast<int>(i) * run_unit, static_cast<int>(i + 1) * run_unit);
        }
        out.end_line();
    }
    return out;
}

}  // namespace

TEST_CASE("components that pass by are those of the whole", "[components]") {
    for (const double density : {0.03, 0.08, 0.15, 0.3}) {
        const auto stack = random_stack(static_cast<unsigned>(1000 * density), density);
        RunComponents whole(Growth{}, 0);
        StreamingComponents passing;
        std::vector<EndedComponent> ended;
        std::vector<std::vector<std::int64_t>> found, expected;
        for (int l = 0; l < layers; ++l) {
            const LabelledLayer labelled = label_layer(stack[static_cast<std::size_t>(l)], l, Growth{});
            whole.add(labelled, l);
            const std::size_t before = ended.size();
            passing.add(labelled, l, {}, ended);
            // What ends, ends with the layer before.
            for (std::size_t k = before; k < ended.size(); ++k)
                CHECK(ended[k].component.extent.last_layer == l - 1);
        }
        passing.finish(ended);
        for (const EndedComponent& e : ended) {
            CHECK(!e.joined);
            found.push_back(numbers_of(e.component.extent));
        }
        for (const std::uint32_t number : whole.numbers())
            expected.push_back(numbers_of(whole.component(number).extent));
        CHECK(expected.size() > 5);
        CHECK(sorted(found) == sorted(expected));
    }
}

TEST_CASE("flags and marks come together where components do", "[components]") {
    // Two columns that a bar joins, and a third one beside them.
    const std::vector<std::vector<std::string>> pictures{
        {"#   #  #"}, {"#   #  #"}, {"#####  #"}, {"  #     "}};
    StreamingComponents passing;
    std::vector<EndedComponent> ended;
    for (int l = 0; l < 4; ++l) {
        ComponentTags tags;
        if (l == 0) {
            tags.flags = {1, 2, 4};
            tags.marks = {{7}, {3, 9}, {}};
        }
        passing.add(label_layer(drawn(pictures[static_cast<std::size_t>(l)]), l, Growth{}), l, tags, ended);
        if (l == 1) CHECK(ended.empty());
        if (l != 2) continue;
        // Both columns are told of as they were: each lacked the other's flags.
        REQUIRE(ended.size() == 2);
        CHECK(ended[0].joined);
        CHECK(ended[0].component.flags == 1);
        CHECK(ended[0].joined_flags == 3);
        CHECK(ended[1].component.flags == 2);
        CHECK(ended[1].component.extent.length == 2 * run_unit);
        ended.clear();
    }
    REQUIRE(ended.size() == 1);
    CHECK(!ended[0].joined);
    CHECK(ended[0].component.flags == 4);
    ended.clear();
    passing.finish(ended);
    REQUIRE(ended.size() == 1);
    CHECK(ended[0].component.flags == 3);
    CHECK(ended[0].component.marks == std::vector<std::uint32_t>{3, 7, 9});
    CHECK(ended[0].component.largest.layer == 2);
    CHECK(ended[0].component.largest.length == 5 * run_unit);
    CHECK(ended[0].component.largest.middle().along == 2.5 * run_unit);
}

TEST_CASE("a patch keeps so many runs at most and counts them all", "[components]") {
    LayerPatch patch;
    for (int i = 0; i < 10000; ++i) patch.include(PlacedRun{0, i, 0, 256});
    LayerPatch other = patch;
    patch.include(other);
    CHECK(patch.length == 2 * 10000 * 256);
    CHECK(patch.runs.size() == LayerPatch::max_kept);
    CHECK(patch.across / static_cast<double>(patch.length) == Approx(4999.5));
}

}  // namespace streaming_components_test
