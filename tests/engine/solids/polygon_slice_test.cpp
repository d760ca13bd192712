#include "engine/solids/polygon_slice.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/contours/contours.h"
#include "engine/field/slice_context.h"

namespace polygon_slice_test {

using namespace lamella;

namespace {

std::vector<std::vector<dvec2>> stars(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> place(-8, 8), angle(0, 6.28), reach(0.5, 5);
    std::vector<std::vector<dvec2>> polygons;
    for (int i = 0; i < count; ++i) {
        const dvec2 center{place(random), place(random)};
        std::vector<dvec2>& polygon = polygons.emplace_back();
        for (int k = 0; k < 9; ++k) {
            const double a = angle(random);  // in no order: sides cross
            polygon.push_back(center + reach(random) * dvec2(std::cos(a), std::sin(a)));
        }
    }
    return polygons;
}

/// How many sides a ray to the right crosses, counted one by one.
bool inside(const std::vector<std::vector<dvec2>>& polygons, dvec2 p) {
    int crossed = 0;
    for (const auto& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            if ((a.y > p.y) == (b.y > p.y)) continue;
            crossed += p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y);
        }
    }
    return crossed % 2 == 1;
}

}  // namespace

TEST_CASE("runs of polygons are where an odd number of them is", "[polygon_slice]") {
    std::mt19937 random(5);
    for (int round = 0; round < 20; ++round) {
        const auto polygons = stars(random, 1 + round % 4);
        const PolygonSlice slice(polygons);
        for (const Axis axis : {Axis::x, Axis::y}) {
            RowBand band;
            band.axis = axis;
            band.along_origin = band.across_origin = round % 2 ? 13 : -13;
            band.along_pitch = band.across_pitch = round % 2 ? -0.1 : 0.1;
            band.sub = 1 + round % 3;
            band.first = 17;
            band.count = 200;
            band.hi = 260;
            Scratch scratch;
            RunRows rows;
            slice.runs(band, scratch, rows);
            REQUIRE(rows.lines() == static_cast<std::size_t>(band.lines()));
            for (int l = 0; l < band.lines(); l += 7) {
                for (int u = 37; u < 260 * run_unit; u += 991) {
                    bool solid = false, close = false;
                    for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                        solid = solid || (run.begin <= u && u < run.end);
                        close = close || std::abs(run.begin - u) <= 1 || std::abs(run.end - u) <= 1;
                    }
                    const double along = band.along(u), across = band.line(l);
                    const dvec2 p = axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
                    if (!close) REQUIRE(solid == inside(polygons, p));
                }
            }
        }
    }
}

TEST_CASE("values of polygons are distances with the side's sign", "[polygon_slice]") {
    const std::vector<std::vector<dvec2>> square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
    const PolygonSlice slice(square);
    std::vector<float> values(4);
    slice.sample({{1, 2}, {4, 3}, 2, 2}, values);
    CHECK(values[0] == Approx(-1));
    CHECK(values[1] == Approx(1));
    CHECK(values[2] == Approx(std::sqrt(0.0) + 1));
    CHECK(values[3] == Approx(std::sqrt(2.0)));
    const Interval range = slice.range({{1, 1}, {3, 3}});
    CHECK(range.lo <= -2);
    CHECK(range.hi >= -1);
    Scratch scratch;
    const auto contours = trace_contours(slice, 0.01, scratch);
    REQUIRE(contours.size() == 1);
    CHECK(signed_area(contours.front().points) == Approx(16).epsilon(1e-3));
    CHECK(PolygonSlice({}).bounds().empty());
    CHECK(trace_contours(PolygonSlice({}), 0.01, scratch).empty());
}

}  // namespace polygon_slice_test
