// Quarter turns: every value and every run against the solid before.
#include "engine/solids/quarter_turn.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/runs/plane_runs.h"

namespace quarter_turn_test {

using namespace lamella;

TEST_CASE("a quarter turn is exact", "[solids]") {
    const int quarters = GENERATE(-1, 1, 2, 3, 4, 6);
    const FieldPtr solid = make_union({make_box({{1, 2, 0}, {9, 4, 3}}), make_torus({-4, 5, 2}, 5, 1.3)});
    const FieldPtr turned = make_quarter_turn(solid, quarters);
    const auto turn = [&](dvec3 p) {
        for (int k = 0; k < ((quarters % 4) + 4) % 4; ++k) p = {-p.y, p.x, p.z};
        return p;
    };
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> number(-12, 12);
    for (int i = 0; i < 500; ++i) {
        const dvec3 p(number(random), number(random), number(random) / 4);
        CHECK(turned->value(turn(p)) == solid->value(p));
    }
    const Box box = turned->bounds();
    CHECK(box.size().x * box.size().y == Approx(solid->bounds().size().x * solid->bounds().size().y));
    // Rows and columns by the sign of the value in the middle of pixels.
    for (const Axis axis : {Axis::x, Axis::y}) {
        RowBand band;
        band.axis = axis;
        band.along_origin = band.across_origin = -13;
        band.along_pitch = band.across_pitch = 0.13;
        band.count = band.hi = 200;
        const RunRows rows = runs_at(*turned, 1.7, band);
        int wrong = 0, right = 0;
        for (int l = 0; l < 200; ++l) {
            for (int pixel = 0; pixel < 200; ++pixel) {
                const std::int32_t middle = pixel * run_unit + run_unit / 2;
                const bool solid_there = std::ranges::any_of(
                    rows.line(static_cast<std::size_t>(l)),
                    [&](const Run& run) { return run.begin <= middle && middle < run.end; });
                const double value = turned->value({on_band(band, middle, l + 0.5), 1.7});
                if (std::abs(value) > 1e-3) ++(solid_there == (value < 0) ? right : wrong);
            }
        }
        CHECK(wrong == 0);
        CHECK(right > 30000);
    }
    SliceContext context;
    const SliceField& slice = context.slice(*turned, 1.7);
    const Tile tile{{-3.1, -7.7}, {0.3, 0.2}, 40, 60};
    std::vector<float> samples(2400);
    slice.sample(tile, samples);
    int same = 0;
    for (int j = 0; j < 60; ++j) {
        for (int i = 0; i < 40; ++i) {
            const double value = turned->value({tile.origin + dvec2(i, j) * tile.step, 1.7});
            same += std::abs(samples[static_cast<std::size_t>(j * 40 + i)] - value) < 1e-4;
        }
    }
    CHECK(same == 2400);
}

}  // namespace quarter_turn_test
