// Components of runs: what touches is joined, within a layer and across layers.
#include "engine/runs/run_components.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <string>

namespace run_components_test {

using namespace lamella;

namespace {

/// One line a string, one run unit a character, '#' is solid.
RunRows drawn(const std::vector<std::string>& lines) {
    RunRows rows;
    for (const std::string& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] == '#') rows.push(static_cast<int>(i), static_cast<int>(i) + 1);
        }
        rows.end_line();
    }
    return rows;
}

std::size_t count_in_plane(const std::vector<std::string>& lines, const Growth& growth) {
    return label_layer(drawn(lines), 0, growth).components.size();
}

RunComponents joined(const std::vector<std::vector<std::string>>& layers, const Growth& growth,
                     std::size_t max_runs = 1000) {
    RunComponents components(growth, max_runs);
    for (std::size_t l = 0; l < layers.size(); ++l) {
        components.add(label_layer(drawn(layers[l]), static_cast<int>(l), growth), static_cast<int>(l));
    }
    return components;
}

using Grid = std::vector<std::vector<std::string>>;

/// Components by flood fill over unit boxes: two are neighbours when they touch after growing.
std::map<std::vector<int>, int> flooded(const Grid& grid, const Growth& g) {
    const int layers = static_cast<int>(grid.size()), rows = static_cast<int>(grid[0].size()),
              columns = static_cast<int>(grid[0][0].size());
    const auto solid = [&](int l, int r, int c) {
        return l >= 0 && l < layers && r >= 0 && r < rows && c >= 0 && c < columns &&
               grid[static_cast<std::size_t>(l)][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] ==
                   '#';
    };
    std::map<std::vector<int>, int> label;
    int count = 0;
    for (int l = 0; l < layers; ++l) {
        for (int r = 0; r < rows; ++r) {
            for (int c = 0; c < columns; ++c) {
                if (!solid(l, r, c) || label.contains({l, r, c})) continue;
                std::vector<std::vector<int>> open{{l, r, c}};
                label[open[0]] = count;
                while (!open.empty()) {
                    const auto at = open.back();
                    open.pop_back();
                    for (int dl = -2 * g.layers - 1; dl <= 2 * g.layers + 1; ++dl) {
                        for (int dr = -2 * g.rows - 1; dr <= 2 * g.rows + 1; ++dr) {
                            for (int dc = -2 * g.units - 1; dc <= 2 * g.units + 1; ++dc) {
                                const std::vector<int> next{at[0] + dl, at[1] + dr, at[2] + dc};
                                if (!solid(next[0], next[1], next[2]) || label.contains(next)) continue;
                                label[next] = count;
                                open.push_back(next);
                            }
                        }
                    }
                }
                ++count;
            }
        }
    }
    return label;
}

}  // namespace

TEST_CASE("runs that touch are joined, corners included") {
    REQUIRE(count_in_plane({"##..", "..##"}, {}) == 1);
    REQUIRE(count_in_plane({"##..", "...#"}, {}) == 2);
    REQUIRE(count_in_plane({"##..", "....", "##.."}, {}) == 2);
    REQUIRE(count_in_plane({"#.#.#", "#####"}, {}) == 1);
    REQUIRE(count_in_plane({"....", "...."}, {}) == 0);
}

TEST_CASE("growing joins what lies within twice the growth") {
    REQUIRE(count_in_plane({"#..#"}, {1, 0, 0}) == 1);
    REQUIRE(count_in_plane({"#...#"}, {1, 0, 0}) == 2);
    REQUIRE(count_in_plane({"#", ".", ".", "#"}, {0, 1, 0}) == 1);
    REQUIRE(count_in_plane({"#", ".", ".", ".", "#"}, {0, 1, 0}) == 2);
    REQUIRE(joined({{"#"}, {"."}, {"."}, {"#"}}, {0, 0, 1}).numbers().size() == 1);
    REQUIRE(joined({{"#"}, {"."}, {"."}, {"."}, {"#"}}, {0, 0, 1}).numbers().size() == 2);
}

TEST_CASE("legs that meet only at the top are one component with the sum of their lengths") {
    RunComponents u = joined({{"#...#"}, {"#...#"}, {"#####"}}, {});
    REQUIRE(u.numbers() == std::vector<std::uint32_t>{0});
    const auto& component = u.component(1);
    REQUIRE(component.extent.length == 9);
    REQUIRE(component.run_count == 5);
    REQUIRE(component.extent.along == Run{0, 5});
    REQUIRE(component.extent.last_layer == 2);
    REQUIRE(u.find(1) == 0);
}

TEST_CASE("marks follow their components") {
    RunComponents components({}, 10);
    auto numbers = components.add(label_layer(drawn({"#.#.#"}), 0, {}), 0);
    REQUIRE(numbers == std::vector<std::uint32_t>{0, 1, 2});
    components.mark(0, 7);
    components.mark(1, 5);
    components.mark(1, 5);
    components.mark(2, 9);
    numbers = components.add(label_layer(drawn({"###.#"}), 1, {}), 1);
    REQUIRE(numbers == std::vector<std::uint32_t>{0, 2});
    REQUIRE(components.component(1).groups == std::vector<std::uint32_t>{5, 7});
    REQUIRE(components.component(2).groups == std::vector<std::uint32_t>{9});
}

TEST_CASE("a component keeps its runs while it is small, and none once it is not") {
    const Grid grid{{"#.#"}, {"#.#"}, {"#.."}, {"#.."}};
    RunComponents components = joined(grid, {}, 3);
    REQUIRE(components.component(0).runs.empty());
    REQUIRE(components.component(0).run_count == 4);
    REQUIRE(components.component(1).runs == std::vector<PlacedRun>{{0, 0, 2, 3}, {1, 0, 2, 3}});
    REQUIRE(components.runs_kept() == 2);
    // Two small ones that join to a large one are forgotten too.
    RunComponents joining = joined({{"#.#"}, {"#.#"}, {"###"}}, {}, 3);
    REQUIRE(joining.runs_kept() == 0);
    REQUIRE(joining.component(0).run_count == 5);
}

TEST_CASE("random grids have the components of a flood fill") {
    const unsigned seed = 21;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 150; ++round) {
        const Growth growth{static_cast<int>(random() % 3), static_cast<int>(random() % 2),
                            static_cast<int>(random() % 3)};
        const unsigned share = growth.units + growth.rows + growth.layers == 0 ? 8 : 60;
        Grid grid(7, std::vector<std::string>(9, std::string(11, '.')));
        for (auto& layer : grid) {
            for (auto& line : layer) {
                for (char& c : line) c = random() % share == 0 ? '#' : '.';
            }
        }
        INFO("round " << round << ", growth " << growth.units << " " << growth.rows << " " << growth.layers);
        const auto expected = flooded(grid, growth);
        RunComponents components(growth, 100000);
        std::map<std::pair<std::uint32_t, int>, int> pairs;
        std::vector<std::pair<std::uint32_t, int>> seen;
        for (int l = 0; l < 7; ++l) {
            const RunRows rows = drawn(grid[static_cast<std::size_t>(l)]);
            const LabelledLayer layer = label_layer(rows, l, growth);
            const auto owners = layer.owners;
            const auto numbers = components.add(layer, l);
            std::size_t i = 0;
            for (int r = 0; r < 9; ++r) {
                for (const Run& run : rows.line(static_cast<std::size_t>(r))) {
                    seen.emplace_back(numbers[owners[i++]], expected.at({l, r, run.begin}));
                }
            }
        }
        for (auto& [number, label] : seen) ++pairs[{components.find(number), label}];
        std::map<std::uint32_t, int> by_number;
        std::map<int, std::uint32_t> by_label;
        for (const auto& [pair, count] : pairs) {
            REQUIRE(by_number.emplace(pair.first, pair.second).second);
            REQUIRE(by_label.emplace(pair.second, pair.first).second);
        }
        REQUIRE(components.numbers().size() == by_number.size());
    }
}

}  // namespace run_components_test
