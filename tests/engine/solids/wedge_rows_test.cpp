// The rows of round triangles against the exact cut.
#include "engine/solids/wedge_rows.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/simd_target.h"
#include "engine/solids/beam_slice.h"

namespace wedge_rows_test {

using namespace lamella;

namespace {

RoundTriangle random_triangle(std::mt19937& random, int round) {
    std::uniform_real_distribution<double> at(-3, 3), radius(0.05, 0.9);
    RoundTriangle t;
    for (std::size_t i = 0; i < 3; ++i) {
        t.corners[i] = {at(random), at(random), at(random) * 0.3};
        t.radii[i] = round % 2 == 0 ? 0.3 : radius(random);
    }
    if (round % 5 == 0) t.corners[0].z = t.corners[1].z = t.corners[2].z;
    if (round % 7 == 0) t.corners[2].x = t.corners[1].x = t.corners[0].x;
    if (round % 11 == 0) t.radii[1] = 0;
    return t;
}

RunRows rows_of(const std::vector<RoundTriangle>& triangles, double z, const RowBand& band) {
    std::vector<Beam> beams;
    for (const RoundTriangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) beams.push_back(edge_beam(t, i));
    }
    RunCollector collector;
    const WedgeRows wedges(triangles, z);
    const BeamRows edges(beams, z);
    collector.clear();
    wedges.collect(band, collector);
    edges.collect(band, collector);
    RunRows rows;
    collector.merge(band, rows);
    return rows;
}

}  // namespace

TEST_CASE("the rows of a round triangle are its exact cuts, on rows and columns, whichever way they run") {
    const unsigned seed = 51;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-1, 1);
    int hits = 0;
    for (int round = 0; round < 1200; ++round) {
        const RoundTriangle t = random_triangle(random, round);
        const double z = (t.corners[0].z + t.corners[1].z + t.corners[2].z) / 3 + 0.5 * at(random);
        RowBand band{round % 3 == 0 ? Axis::y : Axis::x, -5, 0.05, -5, 0.05, 0, 200, 1, 0, 200};
        if (round % 4 == 1) band.along_origin = 5, band.along_pitch = -0.05;
        if (round % 4 == 2) band.across_origin = 5, band.across_pitch = -0.05;
        const RunRows rows = rows_of({t}, z, band);
        const dvec3 direction = band.axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        for (int l = 0; l < band.lines(); ++l) {
            const double v = band.line(l);
            const auto exact = cut(t, band.axis == Axis::x ? dvec3(0, v, z) : dvec3(v, 0, z), direction);
            const auto line = rows.line(static_cast<std::size_t>(l));
            INFO("round " << round << ", line " << l);
            if (!exact) {
                REQUIRE((line.empty() || line.back().end - line[0].begin < 40));
                continue;
            }
            const double u0 = band.coordinate(exact->lo), u1 = band.coordinate(exact->hi);
            // A grazing line has a short run whose ends are ill-conditioned: its depth is what is exact.
            const double slack = 1.01 + (std::abs(u1 - u0) < 200 ? 20 : 0);
            if (line.empty()) {
                REQUIRE(std::abs(u1 - u0) < 40);
                continue;
            }
            ++hits;
            REQUIRE(line.front().begin == Approx(std::min(u0, u1)).margin(slack));
            REQUIRE(line.back().end == Approx(std::max(u0, u1)).margin(slack));
            // Wedge and beams meet without a seam of more than rounding.
            for (std::size_t r = 1; r < line.size(); ++r) REQUIRE(line[r].begin - line[r - 1].end <= 2);
        }
    }
    REQUIRE(hits > 20000);
}

TEST_CASE("the rows of many round triangles are the same bits on every SIMD target and in every band") {
    std::mt19937 random(52);
    std::vector<RoundTriangle> triangles;
    for (int k = 0; k < 200; ++k) triangles.push_back(random_triangle(random, k));
    RowBand band{Axis::x, -5, 0.02, -5, 0.02, 0, 500, 2, 0, 500};
    const RunRows all = rows_of(triangles, 0.1, band);
    REQUIRE(all.runs().size() > 500);
    for (const std::string& target : simd_targets()) {
        INFO("target " << target);
        force_simd_target(target);
        REQUIRE(rows_of(triangles, 0.1, band) == all);
    }
    force_simd_target("");
    band.count = 20;
    for (band.first = 0; band.first < 500; band.first += 20) {
        const RunRows part = rows_of(triangles, 0.1, band);
        for (std::size_t l = 0; l < part.lines(); ++l) {
            const auto got = part.line(l), expected = all.line(static_cast<std::size_t>(band.first) * 2 + l);
            REQUIRE(std::equal(got.begin(), got.end(), expected.begin(), expected.end()));
        }
    }
}

}  // namespace wedge_rows_test
