// Rows of a band that is more than is looked at at once, and of a part of it.
#include "engine/layers/survey_rows.h"

#include <catch2/catch.hpp>

#include "engine/solids/primitives.h"

namespace survey_rows_test {

using namespace lamella;

TEST_CASE("rows of a part of a band are those of the whole band", "[surveys]") {
    const FieldPtr ball = make_sphere(dvec3(0.1, 0.2, 0.3), 9);
    SliceContext context;
    Scratch scratch;
    const SliceField& slice = context.slice(*ball, 1.5);
    const RowBand whole = rows_over({{-10, -10}, {10, 10}}, 0.1);
    const RunRows all = all_rows(slice, whole, scratch);
    REQUIRE(all.lines() == 201);
    CHECK(all.runs().size() > 170);
    for (const auto& [first, count] :
         {std::pair(0, 3), std::pair(17, 1), std::pair(40, 130), std::pair(150, 51)}) {
        RowBand part = whole;
        part.first = first;
        part.count = count;
        RunRows expected;
        expected.append_lines(all, static_cast<std::size_t>(first), static_cast<std::size_t>(count));
        CHECK(all_rows(slice, part, scratch) == expected);
    }
}

}  // namespace survey_rows_test
