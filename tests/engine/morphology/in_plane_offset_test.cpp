// Moved outlines against closed forms, and against true distances in the plane.
#include "engine/morphology/in_plane_offset.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/contours/contours.h"
#include "engine/field/slice_context.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/solids/shapes.h"

namespace in_plane_offset_test {

using namespace lamella;

namespace {

constexpr double tolerance = 0.01;
constexpr double pitch = 0.05;
/// Half a run unit at either end of a run.
constexpr double rounding = pitch / run_unit;

FieldPtr moved(FieldPtr solid, double by) {
    return make_in_plane_offset(std::move(solid), {[by](double) { return by; }, {by, by}}, tolerance);
}

FieldPtr upright_cylinder(dvec2 center, double radius) {
    return make_cylinder({center, -1}, {center, 1}, radius);
}

/// Lines over [-8, 8) in both directions.
RowBand plate(Axis axis) { return {axis, -8, pitch, -8, pitch, 0, 320, 1, 0, 320}; }

RunRows runs_of(const Field& field, double z, const RowBand& band) {
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, z).runs(band, scratch, rows);
    return rows;
}

double area_of(const RunRows& rows) {
    return static_cast<double>(rows.total_length()) * pitch * pitch / run_unit;
}

std::vector<Contour> contours_of(const Field& field, double z, double within) {
    SliceContext context;
    Scratch scratch;
    return trace_contours(context.slice(field, z), within, scratch);
}

double area_of(const std::vector<Contour>& contours) {
    double area = 0;
    for (const Contour& contour : contours) area += signed_area(contour.points);
    return area;
}

bool solid_at(const Field& field, double z, dvec2 p) {
    const RowBand band{Axis::x, p.x, pitch, p.y - pitch / 2, pitch, 0, 1, 1, -1, 1};
    const RunRows rows = runs_of(field, z, band);
    for (const Run& run : rows.line(0)) {
        if (run.begin <= 0 && 0 < run.end) return true;
    }
    return false;
}

/// The width of the only run of each line that has one, mm.
std::vector<double> widths(const RunRows& rows) {
    std::vector<double> list;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        const auto line = rows.line(l);
        if (line.empty()) continue;
        REQUIRE(line.size() == 1);
        list.push_back((line[0].end - line[0].begin) * pitch / run_unit);
    }
    return list;
}

/// A slab with holes, some of which cross its border and each other, and the holes.
struct Cheese {
    FieldPtr solid;
    FieldPtr holes;
};
Cheese cheese() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> at(-5.5, 5.5), height(-0.4, 0.4), radius(0.5, 1.3);
    std::vector<FieldPtr> balls;
    balls.reserve(25);
    for (int k = 0; k < 25; ++k)
        balls.push_back(make_sphere({at(random), at(random), height(random)}, radius(random)));
    const FieldPtr holes = make_union(balls);
    return {make_difference(make_box({{-5, -4, -2}, {5, 4, 2}}), holes), holes};
}

}  // namespace

TEST_CASE("a cube of 10 mm shrunk by 0.2 mm is 9.6 mm wide on every line, and as high as before") {
    const FieldPtr cube = make_box({dvec3(-5), dvec3(5)}), shrunk = moved(cube, -0.2);
    for (const double z : {-4.999, 0.0, 4.999}) {
        for (const Axis axis : {Axis::x, Axis::y}) {
            const auto list = widths(runs_of(*shrunk, z, plate(axis)));
            // Lines stand at the middles of 0.05 mm rows.
            REQUIRE(list.size() == 192);
            for (const double width : list) CHECK(width == Approx(9.6).margin(4e-4));
        }
    }
    CHECK(runs_of(*shrunk, 5.001, plate(Axis::x)).runs().empty());
    CHECK(shrunk->bounds().hi.z == 5);
}

TEST_CASE("a disc grows and shrinks to the disc of the other radius") {
    for (const double by : {-0.5, -0.2, -0.03, 0.03, 0.2, 0.5}) {
        const double radius = 4 + by;
        const FieldPtr field = moved(upright_cylinder({0.123, -0.321}, 4), by);
        INFO("by " << by);
        // Scallops between discs take at most tolerance^2 / (4 by).
        const double most = tolerance * tolerance / (4 * std::abs(by)) + rounding;
        for (const Axis axis : {Axis::x, Axis::y}) {
            const RowBand band = plate(axis);
            const RunRows rows = runs_of(*field, 0, band);
            CHECK(area_of(rows) == Approx(pi * radius * radius).margin(2 * pi * radius * most + 0.01));
            const dvec2 center = axis == Axis::x ? dvec2(0.123, -0.321) : dvec2(-0.321, 0.123);
            for (int l = 0; l < band.lines(); ++l) {
                for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                    const dvec2 end(band.along(run.end) - center.x, band.line(l) - center.y);
                    CHECK(glm::length(end) == Approx(radius).margin(most + rounding));
                }
            }
        }
    }
}

TEST_CASE("the hole of a ring grows when its outline shrinks, and the other way round") {
    const FieldPtr ring = make_difference(upright_cylinder({0, 0}, 5), upright_cylinder({0, 0}, 2));
    for (const double by : {-0.3, 0.3}) {
        const FieldPtr field = moved(ring, by);
        const double outer = 5 + by, inner = 2 - by;
        CHECK(area_of(runs_of(*field, 0, plate(Axis::x))) ==
              Approx(pi * (outer * outer - inner * inner)).epsilon(1e-3));
        CHECK(solid_at(*field, 0, {inner + 0.01, 0}));
        CHECK(!solid_at(*field, 0, {inner - 0.01, 0}));
        CHECK(solid_at(*field, 0, {0, outer - 0.01}));
        CHECK(!solid_at(*field, 0, {0, outer + 0.01}));
    }
    // A hole of 2 mm is closed by growing as much.
    CHECK(solid_at(*moved(ring, 2.05), 0, {0, 0}));
}

TEST_CASE("convex corners stay sharp when an outline shrinks and become round when it grows") {
    constexpr double d = 0.4;
    const FieldPtr square = make_box({{-3, -3, -1}, {3, 3, 1}});
    const FieldPtr shrunk = moved(square, -d), large = moved(square, d);
    CHECK(area_of(runs_of(*shrunk, 0, plate(Axis::x))) == Approx(5.2 * 5.2).epsilon(3e-4));
    CHECK(solid_at(*shrunk, 0, dvec2(2.6 - 0.005)));
    CHECK(!solid_at(*shrunk, 0, dvec2(2.6 + 0.005)));
    CHECK(area_of(runs_of(*large, 0, plate(Axis::x))) == Approx(36 + 4 * 6 * d + pi * d * d).epsilon(3e-4));
    const double diagonal = 3 + d / std::sqrt(2.0);
    CHECK(solid_at(*large, 0, dvec2(diagonal - tolerance)));
    CHECK(!solid_at(*large, 0, dvec2(diagonal + 1e-3)));
    // Concave corners the other way: a shrunk outline is round about them.
    const FieldPtr angle =
        make_difference(make_box({{-3, -3, -1}, {3, 3, 1}}), make_box({{0, 0, -2}, {4, 4, 2}}));
    const double inward = -d / std::sqrt(2.0);
    CHECK(solid_at(*moved(angle, -d), 0, dvec2(inward - 1e-3)));
    CHECK(!solid_at(*moved(angle, -d), 0, dvec2(inward + tolerance)));
    CHECK(solid_at(*moved(angle, d), 0, dvec2(d - 0.005)));
    CHECK(!solid_at(*moved(angle, d), 0, dvec2(d + 0.005)));
}

TEST_CASE("a moved outline lies at the distance asked for from a section of many pieces") {
    const Cheese made = cheese();
    std::mt19937 random(6);
    std::uniform_real_distribution<double> at(-6.5, 6.5);
    int kept_points = 0, taken = 0, added = 0;
    for (const double d : {0.08, 0.25}) {
        const FieldPtr shrunk = moved(made.solid, -d);
        // What a disc about the void reaches is what one about the holes or one about the outside does.
        const FieldPtr holes_grown = moved(made.holes, d);
        for (int k = 0; k < 4000; ++k) {
            const dvec2 p(at(random), at(random));
            const double inward = std::min(5 - d - std::abs(p.x), 4 - d - std::abs(p.y));
            if (std::abs(inward) < 0.003) continue;
            const bool hole = solid_at(*holes_grown, 0.1, p), kept = solid_at(*shrunk, 0.1, p);
            CHECK(kept == (inward > 0 && !hole));
            kept_points += kept;
            taken += !kept && solid_at(*made.solid, 0.1, p);
            added += hole && !solid_at(*made.holes, 0.1, p);
        }
    }
    CHECK(kept_points > 1000);
    CHECK(taken > 200);
    CHECK(added > 200);
}

TEST_CASE("grown discs are the discs of the greater radii, whatever they overlap") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(-5, 5), radius(0.1, 1.2);
    std::vector<FieldPtr> discs;
    std::vector<dvec3> truth;
    for (int k = 0; k < 30; ++k) {
        truth.emplace_back(at(random), at(random), radius(random));
        discs.push_back(upright_cylinder(dvec2(truth.back()), truth.back().z));
    }
    const auto distance = [&](dvec2 p) {
        double least = infinity;
        for (const dvec3& t : truth) least = std::min(least, glm::length(p - dvec2(t)) - t.z);
        return least;
    };
    for (const double d : {0.05, 0.3}) {
        const FieldPtr large = moved(make_union(discs), d);
        // Their complement in a plate shrinks the plate's holes' rims away: the same distance decides.
        const FieldPtr rest =
            moved(make_difference(make_box({{-20, -20, -1}, {20, 20, 1}}), make_union(discs)), -d);
        int near = 0;
        for (int k = 0; k < 6000; ++k) {
            const dvec2 p(at(random), at(random));
            const double off = distance(p) - d;
            if (std::abs(off) < 0.002 + 0.01 * (off > 0 ? 0 : 1)) continue;
            near += std::abs(off) < 0.05;
            CHECK(solid_at(*large, 0, p) == (off < 0));
            CHECK(solid_at(*rest, 0, p) == (off > 0));
        }
        CHECK(near > 100);
    }
}

TEST_CASE("what is thinner than twice the distance vanishes, and gaps as narrow close") {
    const FieldPtr bars =
        make_union({make_box({{-4, -4, -1}, {-3.7, 4, 1}}), make_box({{0, -4, -1}, {0.5, 4, 1}}),
                    make_box({{0.7, -4, -1}, {3, 4, 1}})});
    const FieldPtr shrunk = moved(bars, -0.2);
    CHECK(!solid_at(*shrunk, 0, {-3.85, 0}));
    CHECK(solid_at(*shrunk, 0, {0.25, 0}));
    CHECK(!solid_at(*shrunk, 0, {0.15, 0}));
    CHECK(solid_at(*shrunk, 0, {1, 0}));
    const FieldPtr large = moved(bars, 0.11);
    CHECK(solid_at(*large, 0, {0.6, 0}));
    CHECK(!solid_at(*moved(bars, 0.09), 0, {0.6, 0}));
}

TEST_CASE("rows, columns and contours of a moved outline enclose the same area") {
    for (const double by : {-0.12, 0.12}) {
        const FieldPtr field = moved(cheese().solid, by);
        const auto area = [&](Axis axis) {
            RowBand band = plate(axis);
            band.sub = 32;
            return area_of(runs_of(*field, 0.1, band)) / band.sub;
        };
        const double rows = area(Axis::x), columns = area(Axis::y);
        const double contours = area_of(contours_of(*field, 0.1, 0.02));
        CHECK(rows == Approx(columns).epsilon(1e-3));
        CHECK(rows == Approx(contours).epsilon(1e-3));
    }
}

TEST_CASE("rows and columns of a moved outline tell the same at every point") {
    std::mt19937 random(8);
    const FieldPtr field = moved(cheese().solid, 0.15);
    const RowBand row_band = plate(Axis::x), column_band = plate(Axis::y);
    const RunRows rows = runs_of(*field, 0.1, row_band), columns = runs_of(*field, 0.1, column_band);
    const auto inside = [](const RunRows& lines, std::size_t line, std::int32_t u, std::int32_t margin) {
        for (const Run& run : lines.line(line)) {
            if (run.begin - margin <= u && u < run.end + margin) return true;
        }
        return false;
    };
    for (int k = 0; k < 20000; ++k) {
        const auto i = static_cast<std::int32_t>(random() % 320),
                   j = static_cast<std::int32_t>(random() % 320);
        const auto by_row = [&](int margin) {
            return inside(rows, static_cast<std::size_t>(j), i * run_unit + run_unit / 2, margin);
        };
        const auto by_column = [&](int margin) {
            return inside(columns, static_cast<std::size_t>(i), j * run_unit + run_unit / 2, margin);
        };
        // Where both are sure they agree: a border within a unit of rounding is near along one of the axes.
        if (by_row(-2)) CHECK(by_column(2));
        if (by_column(-2)) CHECK(by_row(2));
    }
}

TEST_CASE("the runs of a moved outline do not depend on bands and clipping") {
    for (const double by : {-0.2, 0.2}) {
        for (const FieldPtr& solid :
             {cheese().solid, make_mesh_field(shapes::closed(shapes::icosphere(3, 4.7)))}) {
            const FieldPtr field = moved(solid, by);
            for (const Axis axis : {Axis::x, Axis::y}) {
                for (const double sign : {1.0, -1.0}) {
                    RowBand band{axis, -8 * sign, pitch * sign, 8 * sign, -pitch * sign, 0, 320, 2, 0, 320};
                    const RunRows all = runs_of(*field, 0.3, band);
                    for (const int count : {1, 7, 64}) {
                        band.count = count;
                        for (band.first = 3; band.first + count <= 320; band.first += 5 * count) {
                            const RunRows part = runs_of(*field, 0.3, band);
                            for (int l = 0; l < band.lines(); ++l) {
                                const auto a = all.line(2 * static_cast<std::size_t>(band.first) +
                                                        static_cast<std::size_t>(l));
                                const auto b = part.line(static_cast<std::size_t>(l));
                                REQUIRE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
                            }
                        }
                    }
                    RowBand half = band;
                    half.first = 0;
                    half.count = 320;
                    half.lo = 100;
                    half.hi = 171;
                    const RunRows clipped = runs_of(*field, 0.3, half);
                    RunRows expected;
                    for (std::size_t l = 0; l < all.lines(); ++l) {
                        for (const Run& run : all.line(l)) {
                            expected.push(std::max(run.begin, 100 * run_unit),
                                          std::min(run.end, 171 * run_unit));
                        }
                        expected.end_line();
                    }
                    REQUIRE(clipped == expected);
                }
            }
        }
    }
}

TEST_CASE("a section that is not moved is the solid's own") {
    const FieldPtr cube = make_box({dvec3(-5), dvec3(5)});
    const FieldPtr field =
        make_in_plane_offset(cube, {[](double z) { return z < 0 ? -0.2 : 0.0; }, {-0.2, 0}}, tolerance);
    SliceContext context;
    CHECK(&context.slice(*field, 0.5) == &context.slice(*cube, 0.5));
    CHECK(&context.slice(*field, -0.5) != &context.slice(*cube, -0.5));
    CHECK(field->value({4.9, 0, 0.5}) < 0);
    CHECK(field->value({4.9, 0, -0.5}) > 0);
    CHECK(field->value({4.7, 0, -0.5}) < 0);
}

TEST_CASE("outlines far beyond the lattice, and offsets that are none, are refused") {
    const FieldPtr cube = make_box({dvec3(-5), dvec3(5)});
    const OutlineOffset by{[](double) { return 0.1; }, {0.1, 0.1}};
    CHECK_THROWS_AS(make_in_plane_offset(nullptr, by, tolerance), InputError);
    CHECK_THROWS_AS(make_in_plane_offset(cube, {nullptr, {0, 1}}, tolerance), InputError);
    CHECK_THROWS_AS(make_in_plane_offset(cube, {by.at, {0, infinity}}, tolerance), InputError);
    CHECK_THROWS_AS(make_in_plane_offset(cube, by, 0), InputError);
    CHECK_THROWS_AS(make_in_plane_offset(cube, by, NAN), InputError);
    const FieldPtr far = moved(make_box({{99999, 0, -1}, {100001, 1, 1}}), 0.1);
    const RowBand band{Axis::x, 99998, pitch, 0, pitch, 0, 10, 1, 0, 60};
    CHECK_THROWS_AS(runs_of(*far, 0, band), InputError);
}

}  // namespace in_plane_offset_test
