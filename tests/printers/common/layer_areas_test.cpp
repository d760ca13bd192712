// Islands and areas of masks against a flood fill over their pixels.
#include "printers/common/layer_areas.h"

#include <catch2/catch.hpp>
#include <random>

namespace layer_areas_test {

using namespace lamella;

namespace {

struct Page {
    int width, height;
    std::vector<std::uint8_t> greys;
    std::uint8_t& at(int x, int y) {
        return greys[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)];
    }
};

/// Takes an island off the page; returns the sum of its greys.
std::uint64_t take_island(Page& page, int x, int y) {
    std::vector<std::pair<int, int>> open{{x, y}};
    std::uint64_t sum = 0;
    while (!open.empty()) {
        const auto [cx, cy] = open.back();
        open.pop_back();
        if (cx < 0 || cy < 0 || cx >= page.width || cy >= page.height || page.at(cx, cy) == 0) continue;
        sum += page.at(cx, cy);
        page.at(cx, cy) = 0;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dy = -1; dy <= 1; ++dy) open.emplace_back(cx + dx, cy + dy);
        }
    }
    return sum;
}

LayerFigures by_flood(Page page) {
    LayerFigures f;
    for (int y = 0; y < page.height; ++y) {
        for (int x = 0; x < page.width; ++x) {
            if (page.at(x, y) == 0) continue;
            if (f.max_x == 0) f = {0, 0, 1e300, 0, page.width, y, 0, 0};
            f.min_x = std::min(f.min_x, x);
            f.max_x = std::max(f.max_x, x + 1);
            f.max_y = y + 1;
        }
    }
    for (int y = 0; y < page.height; ++y) {
        for (int x = 0; x < page.width; ++x) {
            if (page.at(x, y) == 0) continue;
            const double area = static_cast<double>(take_island(page, x, y)) / 255;
            f.total += area;
            f.largest = std::max(f.largest, area);
            f.smallest = std::min(f.smallest, area);
            ++f.islands;
        }
    }
    return f;
}

}  // namespace

TEST_CASE("islands of a mask are those that a flood fill finds", "[layer-areas]") {
    std::mt19937 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        Page page{1 + static_cast<int>(random() % 40), 1 + static_cast<int>(random() % 30), {}};
        const unsigned share = 1 + random() % 8;
        for (int i = 0; i < page.width * page.height; ++i)
            page.greys.push_back(random() % 8 < share ? 0 : static_cast<std::uint8_t>(random() % 3 * 127));
        LayerAreas areas(page.width);
        for (int y = 0; y < page.height; ++y) {
            std::vector<GreyRun> runs;
            for (int x = 0; x < page.width; ++x) {
                runs.push_back({1, page.at(x, y)});
                if (random() % 5 == 0) runs.push_back({0, 77});  // a run without length says nothing
            }
            areas.add(runs);
        }
        const LayerFigures found = areas.figures(), expected = by_flood(page);
        INFO("trial " << trial);
        CHECK(found.total == Approx(expected.total));
        CHECK(found.largest == Approx(expected.largest));
        CHECK(found.smallest == Approx(expected.smallest));
        CHECK(found.islands == expected.islands);
        CHECK(found.min_x == expected.min_x);
        CHECK(found.max_x == expected.max_x);
        CHECK(found.min_y == expected.min_y);
        CHECK(found.max_y == expected.max_y);
    }
}

TEST_CASE("a black mask has no islands and no extent", "[layer-areas]") {
    LayerAreas areas(100);
    for (int row = 0; row < 20; ++row) areas.add(std::vector<GreyRun>{{100, 0}});
    const LayerFigures f = areas.figures();
    CHECK(f.islands == 0);
    CHECK(f.total + f.largest + f.smallest == 0);
    CHECK((f.min_x == 0 && f.max_x == 0 && f.min_y == 0 && f.max_y == 0));
}

}  // namespace layer_areas_test
