// Nesting of outlines: by brute force none overlap, and what fits by eye is found.
#include "engine/layers/outline_nesting.h"

#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "engine/base/error.h"

namespace outline_nesting_test {

using namespace lamella;

namespace {

/// Rows of whole pixels, from text: # is solid; the first line is the highest.
NestTurn picture(const std::vector<std::string>& lines) {
    RunRows rows;
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
        for (std::size_t i = 0; i < line->size(); ++i) {
            const auto begin = static_cast<std::int32_t>(i) * run_unit;
            if ((*line)[i] == '#') rows.push(begin, begin + run_unit);
        }
        rows.end_line();
    }
    const auto widest = std::ranges::max(lines, {}, &std::string::size);
    return {rows, static_cast<std::int32_t>(widest.size()) * run_unit};
}

NestTurn rectangle(int width, int height) {
    return picture(std::vector<std::string>(static_cast<std::size_t>(height),
                                            std::string(static_cast<std::size_t>(width), '#')));
}

/// The runs of a placed shape: row, begin, end.
std::vector<std::array<std::int64_t, 3>> placed_runs(const NestShape& shape, const NestPlace& place) {
    std::vector<std::array<std::int64_t, 3>> runs;
    const RunRows& rows = shape.turns[place.turn].rows;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        for (const Run& run : rows.line(l))
            runs.push_back({static_cast<std::int64_t>(l) + place.y, run.begin + place.x, run.end + place.x});
    }
    return runs;
}

/// The least distance of the shapes on one plate, run units; run ends are points on their rows.
double least_distance(const std::vector<NestShape>& shapes, const std::vector<NestPlace>& places) {
    double least = 1e9;
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (places[i].plate != places[j].plate) continue;
            for (const auto& a : placed_runs(shapes[places[i].shape], places[i])) {
                for (const auto& b : placed_runs(shapes[places[j].shape], places[j])) {
                    const double dy = static_cast<double>(a[0] - b[0]) * run_unit;
                    const auto apart = static_cast<double>(std::max(a[1] - b[2], b[1] - a[2]));
                    // Those that overlap along the row are as far apart as their rows.
                    const double dx = std::max(apart, 0.0);
                    least = std::min(least, a[0] == b[0] && apart < 0 ? -1 : std::hypot(dx, dy));
                }
            }
        }
    }
    return least;
}

void check_all_on_plates(const std::vector<NestShape>& shapes, const std::vector<NestPlace>& places,
                         int width, int height) {
    std::vector<int> left;
    for (const NestShape& shape : shapes) left.push_back(shape.copies);
    for (const NestPlace& place : places) {
        --left.at(place.shape);
        for (const auto& run : placed_runs(shapes[place.shape], place)) {
            CHECK(run[0] >= 0);
            CHECK(run[0] < height);
            CHECK(run[1] >= 0);
            CHECK(run[2] <= std::int64_t{width} * run_unit);
        }
    }
    CHECK(std::ranges::all_of(left, [](int n) { return n == 0; }));
}

}  // namespace

TEST_CASE("shapes lie on their plates without overlap, a gap apart", "[plate]") {
    std::mt19937_64 random(5);
    const auto number = [&](int least, int most) {
        return std::uniform_int_distribution(least, most)(random);
    };
    for (int round = 0; round < 20; ++round) {
        std::vector<NestShape> shapes;
        for (int i = 0; i < 6; ++i) {
            // Corners of two bars, of any widths.
            const int w = number(3, 12), h = number(3, 12), a = number(1, w), b = number(1, h);
            std::vector<std::string> lines;
            for (int y = 0; y < h; ++y) lines.emplace_back(static_cast<std::size_t>(y < b ? w : a), '#');
            NestShape shape{{picture(lines)}, number(1, 3)};
            std::ranges::reverse(lines);
            shape.turns.push_back(picture(lines));
            shapes.push_back(shape);
        }
        const std::int32_t gap = number(0, 3) * run_unit / 2;
        const auto places = nest_outlines(shapes, 30 * run_unit, 20, gap);
        check_all_on_plates(shapes, places, 30, 20);
        const double apart = least_distance(shapes, places);
        CHECK(apart >= 0);
        if (gap > 0) CHECK(apart >= gap - 1);
        const auto again = nest_outlines(shapes, 30 * run_unit, 20, gap);
        for (std::size_t i = 0; i < places.size(); ++i) CHECK(again[i].x == places[i].x);
    }
}

TEST_CASE("a shape lies in the hollow of another", "[plate]") {
    std::vector<NestShape> shapes{{{picture({"#####", "#....", "#....", "#....", "#####"})}, 1},
                                  {{rectangle(3, 3)}, 1}};
    const auto places = nest_outlines(shapes, 5 * run_unit, 5, 0);
    check_all_on_plates(shapes, places, 5, 5);
    CHECK(places[1].plate == 0);
    CHECK(places[1].x == run_unit);
    CHECK(places[1].y == 1);
}

TEST_CASE("a full plate is followed by another, and turns find room", "[plate]") {
    const std::vector<NestShape> squares{{{rectangle(4, 4)}, 7}};
    const auto places = nest_outlines(squares, 8 * run_unit, 8, 0);
    std::multiset<int> plates;
    for (const NestPlace& place : places) plates.insert(place.plate);
    CHECK(plates.count(0) == 4);
    CHECK(plates.count(1) == 3);
    // A bar that is longer than the plate is wide has to stand upright.
    const std::vector<NestShape> bars{{{rectangle(9, 2), rectangle(2, 9)}, 4}};
    for (const NestPlace& place : nest_outlines(bars, 8 * run_unit, 9, 0)) {
        CHECK(place.turn == 1);
        CHECK(place.plate == 0);
    }
    CHECK_THROWS_WITH(nest_outlines(bars, 8 * run_unit, 8, 0), Catch::Contains("shape 0"));
}

}  // namespace outline_nesting_test
