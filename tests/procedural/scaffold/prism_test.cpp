// Runs of upright pieces are where their distance is negative.
#include "procedural/scaffold/prism.h"

#include <catch2/catch.hpp>
#include <random>

namespace prism_test {

using namespace lamella;

namespace {

Prism random_piece(std::mt19937& random, bool round) {
    std::uniform_real_distribution<double> place(-3, 3), half(0.2, 2), angle(0, 6.28);
    const double a = angle(random);
    Prism piece{{place(random), place(random)},
                {std::cos(a), std::sin(a)},
                {half(random), half(random)},
                -1,
                2,
                round};
    if (round) piece.half.y = piece.half.x;
    return piece;
}

}  // namespace

TEST_CASE("rows and columns of upright pieces agree with their distance", "[upright]") {
    std::mt19937 random(3);
    for (int k = 0; k < 60; ++k) {
        const Prism piece = random_piece(random, k % 3 == 0);
        for (const Axis axis : {Axis::x, Axis::y}) {
            RowBand band;
            band.axis = axis;
            band.along_origin = band.across_origin = -6.03;
            band.along_pitch = k % 2 == 0 ? 0.1 : -0.1;
            if (band.along_pitch < 0) band.along_origin = 6.03;
            band.across_pitch = 0.1;
            band.count = band.hi = 121;
            RunCollector runs;
            runs.clear();
            const UprightRows rows({piece});
            rows.collect(band, runs);
            RunRows merged;
            runs.merge(band, merged);
            for (int l = 0; l < band.lines(); ++l) {
                std::vector<std::uint8_t> solid(121, 0);
                for (const Run& run : merged.line(static_cast<std::size_t>(l))) {
                    for (int p = 0; p < 121; ++p) {
                        if (run.begin <= p * run_unit + 128 && p * run_unit + 128 < run.end) {
                            solid[static_cast<std::size_t>(p)] = 1;
                        }
                    }
                }
                for (int p = 0; p < 121; ++p) {
                    const double along = band.along(p * run_unit + 128), across = band.line(l);
                    const dvec2 at = axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
                    const double d = signed_distance(piece, dvec3(at, 0.5));
                    if (std::abs(d) < 1e-3) continue;
                    REQUIRE((d < 0) == (solid[static_cast<std::size_t>(p)] == 1));
                }
            }
        }
    }
}

TEST_CASE("the distance to an upright piece is the way to its nearest point", "[upright]") {
    const Prism box{{1, 2}, {0.6, 0.8}, {2, 0.5}, 0, 3, false};
    const auto at = [&](double u, double v, double z) {
        return dvec3(1 + 0.6 * u - 0.8 * v, 2 + 0.8 * u + 0.6 * v, z);
    };
    CHECK(signed_distance(box, at(0, 0, 1)) == Approx(-0.5));
    CHECK(signed_distance(box, at(3, 0, 1)) == Approx(1));
    CHECK(signed_distance(box, at(5, 4.5, 1)) == Approx(5));
    CHECK(signed_distance(box, at(0, 0, 7)) == Approx(4));
    const Prism disc{{1, 2}, {1, 0}, {2, 2}, 0, 3, true};
    CHECK(signed_distance(disc, {1, 2, 1.5}) == Approx(-1.5));
    CHECK(signed_distance(disc, {6, 2, 7}) == Approx(5));
    const Box around = bounds(box);
    CHECK(around.hi.x == Approx(1 + 0.6 * 2 + 0.8 * 0.5));
    CHECK(around.hi.y == Approx(2 + 0.8 * 2 + 0.6 * 0.5));
}

}  // namespace prism_test
