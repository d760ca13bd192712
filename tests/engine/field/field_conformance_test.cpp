// One suite for every field: runs, samples, ranges and offsets agree with the value at a point.
#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "procedural/lattice/tpms.h"
#include "tests/engine/field/every_line.h"
#include "tests/engine/field/example_fields.h"
#include "tests/engine/solids/shapes.h"

namespace field_conformance_test {

using namespace lamella;

namespace {

RowBand band_of(Axis axis, double pitch, int sub) {
    RowBand band;
    band.axis = axis;
    const int n = static_cast<int>(std::ceil(8 / std::abs(pitch)));
    band.along_origin = pitch > 0 ? -4.013 : 4.007;
    band.along_pitch = pitch;
    band.across_origin = -4.009;
    band.across_pitch = std::abs(pitch) * 1.37;
    band.count = static_cast<int>(8 / band.across_pitch);
    band.sub = sub;
    band.hi = n;
    return band;
}

dvec3 position(const RowBand& band, double u, int line, double z) {
    const double along = band.along(u), across = band.line(line);
    return band.axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z);
}

}  // namespace

TEST_CASE("values that bound distances change by at most 1 per mm") {
    const unsigned seed = 17;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-4, 4), step(-1, 1);
    for (const NamedField& named : all_fields()) {
        if (named.field->metric() == Metric::sign) continue;
        INFO(named.name);
        for (int i = 0; i < 3000; ++i) {
            const dvec3 p(place(random), place(random), place(random));
            const dvec3 q = p + dvec3(step(random), step(random), step(random)) * (i % 2 == 0 ? 1e-3 : 0.3);
            const double change = std::abs(named.field->value(q) - named.field->value(p));
            REQUIRE(change <= glm::distance(p, q) * (1 + 1e-9) + 1e-9);
        }
    }
}

TEST_CASE("runs are solid exactly where the value is negative") {
    const unsigned seed = 11;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> height(-2.2, 2.2);
    for (const NamedField& named : all_fields()) {
        for (int round = 0; round < 4; ++round) {
            const double z = height(random);
            const RowBand band =
                band_of(round % 2 == 0 ? Axis::x : Axis::y, round < 2 ? 0.083 : -0.11, round + 1);
            INFO(named.name << ", z " << z << ", round " << round);
            SliceContext context;
            Scratch scratch;
            RunRows rows;
            context.slice(*named.field, z).runs(band, scratch, rows);
            REQUIRE(rows.lines() == static_cast<std::size_t>(band.lines()));
            const double unit = std::abs(band.along_pitch) / run_unit;
            std::uniform_int_distribution<int> any(0, band.hi * run_unit - 1);
            for (int l = 0; l < band.lines(); ++l) {
                const auto line = rows.line(static_cast<std::size_t>(l));
                const auto inside = [&](double u) {
                    for (const Run& run : line) {
                        if (run.begin <= u && u < run.end) return true;
                    }
                    return false;
                };
                for (int k = 0; k < 24; ++k) {
                    const double u = any(random) + 0.5;
                    const double v = named.field->value(position(band, u, l, z));
                    // A value near zero may fall to either side; a sampled feature under a quarter pitch may
                    // be missed.
                    const double blind = std::max(2 * unit, 2e-5);
                    if (std::abs(v) < blind) continue;
                    INFO("line " << l << ", u " << u << ", value " << v);
                    if ((v < 0) != inside(u)) {
                        const double quarter = std::abs(band.along_pitch) / 4;
                        const Box around{position(band, u, l, z) - quarter,
                                         position(band, u, l, z) + quarter};
                        const bool sampled_sliver =
                            named.sampled && named.field->range(around).contains(0) && std::abs(v) < quarter;
                        REQUIRE(sampled_sliver);
                    }
                }
            }
        }
    }
}

TEST_CASE("closed-form runs equal the runs read off samples") {
    for (const NamedField& named : all_fields()) {
        for (const double z : {-0.61, 0.0137, 0.93}) {
            for (const Axis axis : {Axis::x, Axis::y}) {
                INFO(named.name << ", z " << z << (axis == Axis::x ? ", rows" : ", columns"));
                const RowBand band = band_of(axis, 0.09, 1);
                SliceContext context;
                Scratch scratch;
                RunRows closed, sampled, only_closed, only_sampled;
                context.slice(*named.field, z).runs(band, scratch, closed);
                const Metric metric = named.field->metric();
                sampled_spans(SampledSlice(*named.field, z), metric, band, sampled);
                subtract(closed, sampled, only_closed);
                subtract(sampled, closed, only_sampled);
                for (const RunRows* rest : {&only_closed, &only_sampled}) {
                    for (std::size_t l = 0; l < rest->lines(); ++l) {
                        for (const Run& run : rest->line(l)) {
                            const double middle = (run.begin + run.end) * 0.5;
                            const double v =
                                named.field->value(position(band, middle, static_cast<int>(l), z));
                            INFO("line " << l << ", run " << run.begin << ":" << run.end << ", value " << v);
                            // Ends differ by rounding; between grazing samples a sliver under a quarter pitch
                            // is not seen.
                            const bool same_end = run.end - run.begin <= 2 || std::abs(v) < 2e-5;
                            REQUIRE((same_end || run.end - run.begin <= run_unit / 4));
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("a range encloses every value in its box") {
    const unsigned seed = 5;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-3.5, 3.5), size(0.01, 1.5), unit(0, 1);
    for (const NamedField& named : all_fields()) {
        INFO(named.name);
        for (int round = 0; round < 60; ++round) {
            const dvec3 lo(at(random), at(random), at(random));
            const dvec3 d(size(random), size(random), size(random));
            const Interval range = named.field->range({lo, lo + d});
            for (int k = 0; k < 20; ++k) {
                const double v = named.field->value(lo + d * dvec3(unit(random), unit(random), unit(random)));
                // NaN is outside, so a box with such values is not full.
                REQUIRE((std::isnan(v) ? 0 <= range.hi : range.lo <= v + 1e-9 && v - 1e-9 <= range.hi));
            }
        }
    }
}

TEST_CASE("values and ranges asked for together are those asked for one by one") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> at(-3.5, 3.5), size(0.01, 1.5);
    std::vector<dvec3> points;
    std::vector<Box> boxes;
    for (int i = 0; i < 200; ++i) {
        points.emplace_back(at(random), at(random), at(random));
        boxes.push_back({points.back(), points.back() + dvec3(size(random), size(random), size(random))});
    }
    std::vector<double> values(points.size());
    std::vector<Interval> ranges(boxes.size());
    for (const NamedField& named : all_fields()) {
        INFO(named.name);
        named.field->values(points, values);
        named.field->ranges(boxes, ranges);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double alone = named.field->value(points[i]);
            REQUIRE((std::isnan(alone) ? std::isnan(values[i]) : alone == values[i]));
            const Interval range = named.field->range(boxes[i]);
            REQUIRE((range.lo == ranges[i].lo && range.hi == ranges[i].hi));
        }
    }
}

TEST_CASE("a slice's samples are the field's values, and its bounds hold its runs") {
    for (const NamedField& named : all_fields()) {
        INFO(named.name);
        SliceContext context;
        Scratch scratch;
        const double z = 0.31;
        const SliceField& slice = context.slice(*named.field, z);
        const Tile tile{{-3, -2.5}, {0.47, 0.39}, 13, 11};
        std::vector<float> samples(13 * 11);
        slice.sample(tile, samples);
        for (int j = 0; j < tile.ny; ++j) {
            for (int i = 0; i < tile.nx; ++i) {
                const double v = named.field->value({-3 + i * 0.47, -2.5 + j * 0.39, z});
                const double sample = samples[static_cast<std::size_t>(j * 13 + i)];
                REQUIRE(std::isnan(sample) == std::isnan(v));
                if (!std::isnan(v)) REQUIRE(sample == Approx(v).margin(1e-5));
            }
        }
        RunRows rows;
        const RowBand band = band_of(Axis::x, 0.09, 1);
        slice.runs(band, scratch, rows);
        const Rect bounds = grown(slice.bounds(), 1e-3);
        for (int l = 0; l < band.lines(); ++l) {
            for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                REQUIRE(bounds.lo.y <= band.line(l));
                REQUIRE(band.line(l) <= bounds.hi.y);
                REQUIRE(bounds.lo.x <= band.along(run.begin));
                REQUIRE(band.along(run.end) <= bounds.hi.x);
            }
        }
    }
}

TEST_CASE("a line's runs do not depend on the band it is asked in") {
    for (const NamedField& named : all_fields()) {
        INFO(named.name);
        SliceContext context;
        Scratch scratch;
        const SliceField& slice = context.slice(*named.field, 0.17);
        RowBand whole = band_of(Axis::x, 0.06, 2);
        RunRows all, part;
        slice.runs(whole, scratch, all);
        RowBand band = whole;
        band.count = 7;
        for (band.first = 0; band.first + 7 <= whole.count; band.first += 7) {
            slice.runs(band, scratch, part);
            for (int l = 0; l < band.lines(); ++l) {
                const auto expected = all.line(static_cast<std::size_t>(band.first * 2 + l));
                const auto got = part.line(static_cast<std::size_t>(l));
                REQUIRE(std::equal(expected.begin(), expected.end(), got.begin(), got.end()));
            }
        }
    }
}

TEST_CASE("a line's runs do not depend on whether its neighbours are asked for") {
    for (const NamedField& named : all_fields()) {
        INFO(named.name);
        SliceContext context;
        const SliceField& slice = context.slice(*named.field, 0.17);
        for (const Axis axis : {Axis::x, Axis::y}) {
            RowBand band = band_of(axis, axis == Axis::x ? 0.06 : -0.07, 4);
            CHECK(require_same_lines_by_steps(slice, band) > 0);
            // The same lines from the other side, with numbers below 0.
            band.across_origin += 30 * band.across_pitch;
            band.across_pitch = -band.across_pitch;
            band.first = -40;
            CHECK(require_same_lines_by_steps(slice, band) > 0);
        }
    }
}

TEST_CASE("an offset solid is the set of points within the offset of the solid") {
    const unsigned seed = 3;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-4, 4);
    for (const NamedField& named : all_fields()) {
        if (named.field->metric() != Metric::exact) continue;
        for (const double d : {0.25, -0.25}) {
            INFO(named.name << " by " << d);
            const FieldPtr moved = make_offset(named.field, d);
            for (int k = 0; k < 400; ++k) {
                const dvec3 p(at(random), at(random), at(random));
                const double v = named.field->value(p) - d;
                if (std::abs(v) < 1e-9) continue;
                REQUIRE((moved->value(p) < 0) == (v < 0));
            }
        }
    }
}

TEST_CASE("a filled body has the value of the set operations that it stands for") {
    const unsigned seed = 4;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-3, 3);
    const FieldPtr filling = make_union({make_torus({0, 0.1, 0}, 1.5, 0.4), make_sphere({1.5, 1, 0.5}, 0.6)});
    for (const FieldPtr& body :
         {make_mesh_field(shapes::closed(shapes::icosphere(3, 2.4))), make_sphere({0, 0, 0}, 2.5)}) {
        for (const double t : {0.0, 0.4}) {
            const FieldPtr filled = make_filled_body(body, filling, t);
            const FieldPtr inside = t > 0 ? make_union({filling, make_shell(body, t)}) : filling;
            const FieldPtr expected = make_intersection({body, inside});
            for (int k = 0; k < 2000; ++k) {
                const dvec3 p(at(random), at(random), at(random));
                REQUIRE(filled->value(p) == Approx(expected->value(p)).margin(1e-12));
            }
        }
    }
}

TEST_CASE("a solid without a true offset says so") {
    const FieldPtr sheet = make_tpms({TpmsKind::gyroid,
                                      false,
                                      make_constant_grading(2),
                                      make_constant_grading(0.3),
                                      {dvec3(-4.5), dvec3(4.5)}});
    REQUIRE_THROWS_AS(make_offset(sheet, 0.1), InputError);
    REQUIRE_THROWS_AS(make_shell(sheet, 0.1), InputError);
}

TEST_CASE("impossible sizes are refused") {
    REQUIRE_THROWS_AS(make_sphere({0, 0, 0}, 0), InputError);
    REQUIRE_THROWS_AS(make_sphere({0, 0, 0}, NAN), InputError);
    REQUIRE_THROWS_AS(make_box({{0, 0, 0}, {1, 0, 1}}), InputError);
    REQUIRE_THROWS_AS(make_box({{0, 0, 0}, {1, 1, 1}}, 0.6), InputError);
    REQUIRE_THROWS_AS(make_cylinder({0, 0, 0}, {0, 0, 0}, 1), InputError);
    REQUIRE_THROWS_AS(make_torus({0, 0, 0}, 1, 1), InputError);
    REQUIRE_THROWS_AS(make_half_space({0, 0, 0}, 1), InputError);
    REQUIRE_THROWS_AS(make_union({}), InputError);
    REQUIRE_THROWS_AS(make_transform(make_sphere({0, 0, 0}, 1), glm::dmat3(0), {0, 0, 0}), InputError);
}

TEST_CASE("a value that is not a number is outside") {
    class Hole : public Field {
      public:
        double value(dvec3 p) const override { return p.x < 0 ? NAN : glm::length(p) - 2; }
        Interval range(const Box& /*box*/) const override { return {-infinity, infinity}; }
        Metric metric() const override { return Metric::sign; }
        Box bounds() const override { return {dvec3(-2), dvec3(2)}; }
    };
    const auto hole = std::make_shared<Hole>();
    const RowBand band = band_of(Axis::x, 0.1, 1);
    for (const FieldPtr& field : {FieldPtr(hole), make_union({hole, make_empty()}),
                                  make_intersection({hole, make_sphere({0, 0, 0}, 3)})}) {
        SliceContext context;
        Scratch scratch;
        RunRows rows;
        context.slice(*field, 0.1).runs(band, scratch, rows);
        REQUIRE(rows.total_length() > 0);
        for (const Run& run : rows.runs()) REQUIRE(band.along(run.begin) > -0.01);
    }
}

}  // namespace field_conformance_test
