// Rectangles on a sheet keep their distance, from each other and from the edges.
#include "printers/vector/sheet_nesting.h"

#include <catch2/catch.hpp>
#include <random>

namespace sheet_nesting_test {

using namespace lamella;

TEST_CASE("no two rectangles of a sheet come nearer than the margin, whatever their sizes", "[nesting]") {
    const unsigned seed = GENERATE(1U, 2U, 3U, 4U);
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> side(1, 80);
    const dvec2 size(300, 200);
    const double margin = 4;
    int sheets = 0;
    std::vector<Rect> placed;
    ShelfSheet sheet(size, margin);
    for (int i = 0; i < 400; ++i) {
        const dvec2 rectangle(side(random), side(random));
        auto corner = sheet.place(rectangle);
        if (!corner) {
            ++sheets;
            CHECK(placed.size() > 4);  // a sheet is not left all but empty
            placed.clear();
            sheet = ShelfSheet(size, margin);
            corner = sheet.place(rectangle);
        }
        REQUIRE(corner);
        const Rect here{*corner, *corner + rectangle};
        const double tiny = 1e-5;
        CHECK(here.lo.x >= margin - tiny);
        CHECK(here.lo.y >= margin - tiny);
        CHECK(here.hi.x <= size.x - margin + tiny);
        CHECK(here.hi.y <= size.y - margin + tiny);
        for (const Rect& other : placed) CHECK(intersect(grown(here, margin - tiny), other).empty());
        placed.push_back(here);
    }
    CHECK(sheets > 3);
}

TEST_CASE("a rectangle as large as the room fits, a larger one does not", "[nesting]") {
    const dvec2 size(100, 60);
    CHECK(usable_sheet_size(size, 5) == dvec2(90, 50));
    const auto corner = ShelfSheet(size, 5).place({90, 50});
    REQUIRE(corner);
    CHECK(corner->x == Approx(5));
    CHECK(corner->y == Approx(5));
    CHECK(!ShelfSheet(size, 5).place({90.1, 50}));
    CHECK(!ShelfSheet(size, 5).place({90, 50.1}));
}

TEST_CASE("a sheet is filled from the top left, and gaps in upper shelves are used", "[nesting]") {
    ShelfSheet sheet({100, 100}, 0);
    CHECK(sheet.empty());
    CHECK(*sheet.place({60, 30}) == dvec2(0, 70));
    CHECK(*sheet.place({60, 30}) == dvec2(0, 40));
    CHECK(*sheet.place({40, 20}) == dvec2(60, 80));
    CHECK(*sheet.place({40, 50}) == dvec2(60, 20));  // the lowest shelf grows
    CHECK(!sheet.place({10, 30}));
    CHECK(*sheet.place({100, 20}) == dvec2(0, 0));
    CHECK(!sheet.empty());
}

}  // namespace sheet_nesting_test
