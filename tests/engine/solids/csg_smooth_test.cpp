// Rounded unions and differences: fillets of the stated width, and nothing changed away from the seam.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/runs/plane_runs.h"

namespace csg_smooth_test {

using namespace lamella;

namespace {

const FieldPtr floor_slab = make_box({{-10, -10, -10}, {10, 10, 0}});
const FieldPtr wall_slab = make_box({{-10, -10, -10}, {0, 10, 10}});

}  // namespace

TEST_CASE("the fillet of two walls leaves each of them one radius from their corner") {
    constexpr double radius = 2;
    const FieldPtr both = make_smooth_union(floor_slab, wall_slab, radius);
    // On the floor, z = 0+: solid up to x = radius, where the fillet ends.
    CHECK(both->value({radius - 0.1, 0, 1e-5}) < 0);
    CHECK(both->value({radius + 0.1, 0, 1e-5}) > 0);
    CHECK(both->value({1e-5, 0, radius - 0.1}) < 0);
    CHECK(both->value({1e-5, 0, radius + 0.1}) > 0);
    // On the diagonal x = z = t: t - radius / 4 = 0.
    const double t = radius / 4;
    CHECK(both->value({t - 1e-6, 0, t - 1e-6}) < 0);
    CHECK(both->value({t + 1e-6, 0, t + 1e-6}) > 0);
}

TEST_CASE("the volume of a fillet is that under its parabola") {
    // With x, z > 0 outside both: min - (r - |x - z|)^2 / (4 r) < 0. With d = |x - z|, m = min: m < (r - d)^2
    // / 4r; the area is 2 times the integral of (r - d)^2 / 4r over d from 0 to r, r^2 / 6.
    constexpr double radius = 2.4;
    const FieldPtr both = make_smooth_union(floor_slab, wall_slab, radius);
    const Box corner{{0, -1, 0}, {3, 1, 3}};
    CHECK(volume_in(*both, corner, 0.02) == Approx(2 * radius * radius / 6).epsilon(1e-3));
}

TEST_CASE("a rounded edge lacks what a fillet has") {
    // The edge x = z = 0 of the floor that is left beside a wall taken away.
    constexpr double radius = 2.4;
    const FieldPtr rest = make_smooth_difference(floor_slab, wall_slab, radius);
    const Box corner{{0, -1, -3}, {3, 1, 0}};
    CHECK(volume_in(*rest, corner, 0.05) == Approx(2 * 9 - 2 * radius * radius / 6).epsilon(1e-3));
    CHECK(rest->value({radius + 0.1, 0, -1e-5}) < 0);
    CHECK(rest->value({radius - 0.1, 0, -1e-5}) > 0);
}

TEST_CASE("away from the seam, runs are those of the plain operations to the last unit") {
    constexpr double radius = 0.7;
    const FieldPtr ring = make_torus({0, 0, 0}, 6, 2);
    const FieldPtr ball = make_sphere({5, 1, 0.5}, 2.5);
    const FieldPtr near_ball = make_sphere({5, 1, 0.5}, 2.5 + radius);
    const RowBand band = band_over({{-10, -10, -3}, {10, 10, 3}}, 0.04);
    for (double z = -2.97; z < 3.2; z += 0.37) {
        const RunRows near = runs_at(*near_ball, z, band);
        RunRows rest, plain_rest;
        subtract(runs_at(*make_smooth_union(ring, ball, radius), z, band), near, rest);
        subtract(runs_at(*make_union({ring, ball}), z, band), near, plain_rest);
        CHECK(rest == plain_rest);
        RunRows cut, plain_cut;
        subtract(runs_at(*make_smooth_difference(ring, ball, radius), z, band), near, cut);
        subtract(runs_at(*make_difference(ring, ball), z, band), near, plain_cut);
        CHECK(cut == plain_cut);
    }
}

TEST_CASE("a rounded union holds both, and a rounded difference nothing of what is taken") {
    const FieldPtr ring = make_torus({0, 0, 0}, 6, 2);
    const FieldPtr ball = make_sphere({5, 1, 0.5}, 2.5);
    const RowBand band = band_over({{-10, -10, -3}, {10, 10, 3}}, 0.05);
    for (double z = -2.4; z < 2.5; z += 0.4) {
        const RunRows both = runs_at(*make_smooth_union(ring, ball, 0.9), z, band);
        RunRows missing, left;
        subtract(runs_at(*make_union({ring, ball}), z, band), both, missing);
        CHECK(missing.runs().empty());
        intersect(runs_at(*make_smooth_difference(ring, ball, 0.9), z, band), runs_at(*ball, z, band), left);
        CHECK(left.runs().empty());
    }
}

TEST_CASE("rounded seams need two solids and a positive, finite radius") {
    for (const double radius : {0.0, -1.0, infinity, std::nan("")}) {
        CHECK_THROWS_AS(make_smooth_union(floor_slab, wall_slab, radius), InputError);
        CHECK_THROWS_AS(make_smooth_difference(floor_slab, wall_slab, radius), InputError);
    }
    CHECK_THROWS_AS(make_smooth_difference(floor_slab, nullptr, 1), InputError);
}

}  // namespace csg_smooth_test
