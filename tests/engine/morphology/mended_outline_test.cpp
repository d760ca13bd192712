// Mended outlines: thin walls come to their thickness and no more, gaps are filled, and the rest stays.
#include "engine/morphology/mended_outline.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/checks/print_check.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace mended_outline_test {

using namespace lamella;

namespace {

constexpr double pitch = 0.05, pi = 3.14159265358979;

glm::dmat3 about_z(double degrees) {
    const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    return {c, s, 0, -s, c, 0, 0, 0, 1};
}

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

/// A block with a fin, turned.
FieldPtr block_with_fin(double thickness, double degrees) {
    const FieldPtr fin = box({-4, -thickness / 2, -1}, {6, thickness / 2, 1});
    return make_transform(make_union({box({-10, -4, -1}, {0, 4, 1}), fin}), about_z(degrees), dvec3(0));
}

RunRows rows_of(const FieldPtr& solid, const RowBand& band) {
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(*solid, 0).runs(band, scratch, rows);
    return rows;
}

/// The length of solid along a way that begins in the void, mm.
double length_along(const FieldPtr& solid, dvec2 from, dvec2 to) {
    SliceContext context;
    const SliceField& slice = context.slice(*solid, 0);
    constexpr int steps = 200;
    int inside = 0;
    for (int k = 0; k < steps; ++k) {
        float v = 0;
        slice.sample({from + (to - from) * ((k + 0.5) / steps), dvec2(1), 1, 1}, std::span(&v, 1));
        if (v < 0) ++inside;
    }
    const dvec2 way = to - from;
    return std::sqrt(way.x * way.x + way.y * way.y) * inside / steps;
}

CheckReport check(const FieldPtr& part, Check kind, double limit) {
    Job job = scenes::job_of(part, part->bounds(), 0.5);
    PrintCheckOptions options;
    options.limits.verdicts[static_cast<std::size_t>(kind)] = Severity::fail;
    options.limits.thickness = options.limits.gap = limit;
    options.pitch = limit / 6;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {});
    return checks.report();
}

RowBand band_about(const FieldPtr& solid, Axis axis, double band_pitch) {
    const Box bounds = solid->bounds();
    RowBand band{.axis = axis, .along_pitch = band_pitch, .across_pitch = band_pitch};
    band.along_origin = axis == Axis::x ? bounds.lo.x : bounds.lo.y;
    band.across_origin = axis == Axis::x ? bounds.lo.y : bounds.lo.x;
    band.lo = -100;
    band.hi = band.count = static_cast<int>(40 / band_pitch);
    return band;
}

}  // namespace

TEST_CASE("a fin comes to the thickness asked for, whichever way it stands", "[mended]") {
    for (const double degrees : {0.0, 20.0, 45.0, 90.0}) {
        for (const double thickness : {0.15, 0.33, 0.5, 0.65}) {
            const FieldPtr part = block_with_fin(thickness, degrees),
                           mended = make_thickened(part, 0.8, pitch);
            INFO("turned by " << degrees << ", " << thickness << " mm thick");
            if (thickness < 0.4) CHECK(!check(part, Check::thickness, 0.8).passed());
            CHECK(check(mended, Check::thickness, 0.8).passed());
            const glm::dmat3 turn = about_z(degrees);
            for (const double x : {3.0, 5.5}) {
                const double across =
                    length_along(mended, dvec2(turn * dvec3(x, -2, 0)), dvec2(turn * dvec3(x, 2, 0)));
                CHECK(across > 0.8 - 1.5 * pitch);
                CHECK(across < 1.25 * 0.8 + 1.5 * pitch);
            }
        }
    }
}

TEST_CASE("what is thick enough stays as it is", "[mended]") {
    const FieldPtr part = block_with_fin(0.9, 30), thickened = make_thickened(part, 0.8, pitch),
                   filled = make_gaps_filled(part, 0.8, pitch);
    for (const Axis axis : {Axis::x, Axis::y}) {
        const RowBand band = band_about(part, axis, 0.07);
        const RunRows rows = rows_of(part, band);
        CHECK(!rows.runs().empty());
        CHECK(rows_of(thickened, band) == rows);
        CHECK(rows_of(filled, band) == rows);
    }
    // Only the fin of a block with a thin one changes: nothing does left of where it begins.
    const FieldPtr thin = block_with_fin(0.3, 0), mended = make_thickened(thin, 0.8, pitch);
    RowBand left = band_about(thin, Axis::x, 0.07);
    left.hi = static_cast<int>(10 / 0.07);
    CHECK(rows_of(mended, left) == rows_of(thin, left));
}

TEST_CASE("a narrow slot is filled, a wide one is not", "[mended]") {
    const auto slotted = [](double width, double degrees) {
        return make_transform(
            make_difference(box({-6, -6, -1}, {6, 6, 1}), box({-3, -width / 2, -2}, {8, width / 2, 2})),
            about_z(degrees), dvec3(0));
    };
    for (const double degrees : {0.0, 25.0, 45.0, 90.0}) {
        INFO("turned by " << degrees);
        const FieldPtr part = slotted(0.4, degrees), filled = make_gaps_filled(part, 0.8, pitch);
        CHECK(!check(part, Check::gaps, 0.8).passed());
        CHECK(check(filled, Check::gaps, 0.8).passed());
        const glm::dmat3 turn = about_z(degrees);
        // Along the slot's middle, from the side of its blind end.
        const double along =
            length_along(filled, dvec2(turn * dvec3(-7, 0, 0)), dvec2(turn * dvec3(7, 0, 0)));
        CHECK(along > 12 - 1.5 * 0.4 - 3 * pitch);
        CHECK(along < 12 + pitch);
        const FieldPtr wide = slotted(0.9, degrees);
        const RowBand band = band_about(wide, Axis::x, 0.07);
        CHECK(rows_of(make_gaps_filled(wide, 0.8, pitch), band) == rows_of(wide, band));
    }
}

TEST_CASE("bands of a mended outline are parts of the whole", "[mended]") {
    const FieldPtr mended = make_gaps_filled(make_thickened(block_with_fin(0.3, 33), 0.8, pitch), 0.5, pitch);
    for (const Axis axis : {Axis::x, Axis::y}) {
        const RowBand whole = band_about(mended, axis, 0.06);
        const RunRows rows = rows_of(mended, whole);
        RowBand part = whole;
        for (part.first = 0; part.first < whole.count; part.first += 7) {
            part.count = std::min(7, whole.count - part.first);
            const RunRows some = rows_of(mended, part);
            for (std::size_t l = 0; l < some.lines(); ++l) {
                const auto a = some.line(l), b = rows.line(l + static_cast<std::size_t>(part.first));
                REQUIRE(std::vector<Run>(a.begin(), a.end()) == std::vector<Run>(b.begin(), b.end()));
            }
        }
    }
}

TEST_CASE("mending refuses what makes no sense", "[mended]") {
    CHECK_THROWS_AS(make_thickened(nullptr, 0.8, pitch), InputError);
    CHECK_THROWS_AS(make_thickened(box(dvec3(0), dvec3(1)), 0.1, pitch), InputError);
    CHECK_THROWS_AS(make_gaps_filled(box(dvec3(0), dvec3(1)), 0.8, 0), InputError);
}

}  // namespace mended_outline_test
