// What a recipe's [process] and the side of its skin do to the part and its layers.
#include "recipe/build/build_process.h"

#include <catch2/catch.hpp>

#include "recipe/identity.h"
#include "tests/app/commands/recipes.h"

namespace build_process_test {

using namespace lamella;

namespace {

const std::string cube = "[part]\nshape = \"box\"\nsize = [10, 10, 10]\n[layers]\nheight = 0.1\n";

BuiltJob built(const std::string& text) { return build_job(recipe_of(cube + text)); }

std::string complaint(const std::string& text) { return complaint_about(cube + text); }

/// Widths of the layer's only run through its middle, along x and along y, mm.
dvec2 widths(const Job& job, int index) {
    const Layer layer(job, index);
    dvec2 found{0};
    for (const Axis axis : {Axis::x, Axis::y}) {
        const RowBand band{axis, -10, 0.05, 0.01, 0.05, 0, 1, 1, 0, 400};
        RunRows rows;
        layer.runs(band, rows);
        if (rows.runs().empty()) continue;
        const auto runs = rows.line(0);
        found[axis == Axis::x ? 0 : 1] = (runs.back().end - runs.front().begin) * band.along_pitch / run_unit;
    }
    return found;
}

void check_widths(const Job& job, int index, double x, double y) {
    INFO("layer " << index);
    const dvec2 found = widths(job, index);
    CHECK(found.x == Approx(x).margin(5e-4));
    CHECK(found.y == Approx(y).margin(5e-4));
}

}  // namespace

TEST_CASE("an elephant's foot is taken off the first layer alone unless told otherwise") {
    const Job job = built("[process]\nelephant_foot = 0.2\n").job;
    REQUIRE(job.layers.count() == 100);
    check_widths(job, 0, 9.6, 9.6);
    check_widths(job, 1, 10, 10);
    check_widths(job, 99, 10, 10);
}

TEST_CASE("an elephant's foot fades evenly over its layers") {
    const Job job = built("[process]\nelephant_foot = 0.4\nelephant_foot_layers = 4\n").job;
    for (int layer = 0; layer < 4; ++layer) {
        const double width = 10 - 2 * 0.4 * (1 - layer / 4.0);
        check_widths(job, layer, width, width);
    }
    check_widths(job, 4, 10, 10);
}

TEST_CASE("xy compensation moves every outline, and the bounds where it grows") {
    const Job large = built("[process]\nxy_compensation = 0.15\nelephant_foot = 0.2\n").job;
    check_widths(large, 0, 9.9, 9.9);
    check_widths(large, 50, 10.3, 10.3);
    check_widths(large, 99, 10.3, 10.3);
    CHECK(large.bounds.lo == dvec3(-5.15, -5.15, -5));
    CHECK(large.bounds.hi == dvec3(5.15, 5.15, 5));
    CHECK(large.layers.count() == 100);
    const Job small = built("[process]\nxy_compensation = -0.15\n").job;
    check_widths(small, 0, 9.7, 9.7);
    check_widths(small, 99, 9.7, 9.7);
    CHECK(small.bounds.hi == dvec3(5));
}

TEST_CASE("a part is scaled about its middle from its lowest point, its skin with it") {
    const BuiltJob job = built("[skin]\nthickness = 1\n[process]\nscale = [1.1, 0.9, 1.2]\n");
    const Box& bounds = job.job.bounds;
    CHECK(bounds.lo.x == Approx(-5.5));
    CHECK(bounds.hi.y == Approx(4.5));
    CHECK(bounds.lo.z == -5);
    CHECK(bounds.hi.z == Approx(7));
    CHECK(job.job.layers.count() == 120);
    check_widths(job.job, 60, 11, 9);
    const Field& part = *job.job.part;
    CHECK(part.value({5.5 - 1.09, 0, 1}) < 0);
    CHECK(part.value({5.5 - 1.11, 0, 1}) > 0);
    CHECK(part.value({0, 4.5 - 0.89, 1}) < 0);
    CHECK(part.value({0, 4.5 - 0.91, 1}) > 0);
    CHECK(part.value({0, 0, -5 + 1.19}) < 0);
    CHECK(part.value({0, 0, -5 + 1.21}) > 0);
}

TEST_CASE("outlines are moved by the distance as printed, whatever the scale") {
    const Job job = built("[process]\nscale = [1.1, 0.9, 1.2]\nelephant_foot = 0.2\n").job;
    check_widths(job, 0, 10.6, 8.6);
    check_widths(job, 1, 11, 9);
}

TEST_CASE("a scaled part is cut where the designed one would be") {
    const std::string foam = "[foam]\ncell = 2\nbeam = 0.2\n";
    const BuiltJob scaled = built(foam + "[process]\nscale = [1.25, 1.25, 2]\n");
    REQUIRE(scaled.job.layers.count() == scaled.designed.layers.count());
    for (const int index : {0, 77, 199}) {
        const Layer printed(scaled.job, index), designed(scaled.designed, index);
        RunRows got, expected;
        printed.runs({Axis::x, -6.25, 0.0625, -6.25, 0.0625, 0, 200, 1, 0, 200}, got);
        designed.runs({Axis::x, -5, 0.05, -5, 0.05, 0, 200, 1, 0, 200}, expected);
        REQUIRE(!expected.runs().empty());
        // The plane's height and the positions may differ by a rounding.
        CHECK(std::abs(got.total_length() - expected.total_length()) < 200);
    }
}

TEST_CASE("islands are dropped from a scaled part as from the designed one") {
    const std::string foam =
        "[foam]\nkind = \"k-nearest\"\nneighbours = 2\ncell = 1.2\nbeam = 0.12\ndrop_islands = true\n";
    const std::string process = "[process]\nscale = [1.1, 1.1, 1]\nelephant_foot = 0.05\n";
    const Recipe plain = recipe_of(cube + foam), processed = recipe_of(cube + foam + process);
    BuiltJob a = build_job(plain), b = build_job(processed);
    drop_islands(plain, a, {});
    drop_islands(processed, b, {});
    REQUIRE(a.islands->count > 0);
    CHECK(a.islands->count == b.islands->count);
    CHECK(a.islands->volume == b.islands->volume);
    const Layer one(a.job, 40), other(b.job, 40), kept(b.designed, 40);
    RunRows expected, got;
    one.runs({Axis::x, -5, 0.05, -5, 0.05, 0, 200, 1, 0, 200}, expected);
    kept.runs({Axis::x, -5, 0.05, -5, 0.05, 0, 200, 1, 0, 200}, got);
    CHECK(got == expected);
    other.runs({Axis::x, -5.5, 0.055, -5.5, 0.055, 0, 200, 1, 0, 200}, got);
    CHECK(std::abs(got.total_length() - expected.total_length()) < 500);
}

TEST_CASE("a skin outside makes the part larger and leaves the foam the whole body") {
    const BuiltJob outside = built("[skin]\nthickness = 1\nside = \"outside\"\n");
    CHECK(outside.job.bounds.lo == dvec3(-6));
    CHECK(outside.job.bounds.hi == dvec3(6));
    CHECK(outside.job.layers.count() == 120);
    check_widths(outside.job, 0, 10 + 2 * std::sqrt(1 - 0.95 * 0.95), 10 + 2 * std::sqrt(1 - 0.95 * 0.95));
    check_widths(outside.job, 60, 12, 12);
    CHECK(outside.job.part->value({5.01, 0, 0}) < 0);
    CHECK(outside.job.part->value({4.99, 0, 0}) > 0);
    const BuiltJob centred = built("[skin]\nthickness = 1\nside = \"centred\"\n");
    CHECK(centred.job.bounds.hi == dvec3(5.5));
    CHECK(centred.job.part->value({4.51, 0, 0}) < 0);
    CHECK(centred.job.part->value({4.49, 0, 0}) > 0);
    const BuiltJob inside = built("[skin]\nthickness = 1\nside = \"inside\"\n");
    CHECK(inside.job.bounds.hi == dvec3(5));
    CHECK(inside.job.identity == built("[skin]\nthickness = 1\n").job.identity);
    CHECK(inside.job.identity != outside.job.identity);
}

TEST_CASE("settings of a process that change nothing leave the part as it is") {
    const BuiltJob plain = built(""), idle = built("[process]\nscale = [1, 1, 1]\nxy_compensation = 0\n");
    CHECK(idle.job.part == idle.designed.part);
    CHECK(idle.job.layers.count() == plain.job.layers.count());
    CHECK(job_identity(recipe_of(cube)) !=
          job_identity(recipe_of(cube + "[process]\nelephant_foot = 0.2\n")));
}

TEST_CASE("a process that cannot be is refused with the key and what is accepted") {
    const auto mentions = [](const std::string& text, const std::string& part) {
        UNSCOPED_INFO(text);
        return text.find(part) != std::string::npos;
    };
    CHECK(mentions(complaint("[process]\nscale = [1, 0, 1]\n"), "test.toml:7: process.scale"));
    CHECK(mentions(complaint("[process]\nelephant_foot = -0.1\n"), "test.toml:7: process.elephant_foot"));
    CHECK(mentions(complaint("[process]\nxy_compensation = 11\n"), "-10 to 10 mm"));
    CHECK(mentions(complaint("[process]\nelephant_foot_layers = 3\n"),
                   "process.elephant_foot_layers: has no effect while process.elephant_foot is 0; accepted: "
                   "process.elephant_foot"));
    CHECK(mentions(complaint("[skin]\nthickness = 1\nside = \"middle\"\n"), "inside, outside, centred"));
    CHECK(mentions(complaint("[skin]\nside = \"outside\"\n"), "skin.thickness"));
    const std::string gyroid =
        "[part]\nshape = \"gyroid\"\nsize = [9, 9, 9]\nperiod = 3\nthickness = 0.5\n[skin]\nthickness = "
        "0.2\n";
    try {
        build_job(recipe_of(gyroid + "side = \"outside\"\n"));
        FAIL("a gyroid has no offset");
    } catch (const InputError& error) {
        CHECK(mentions(error.what(), "test.toml:7: skin.thickness: this shape has no exact 3D offset"));
    }
}

}  // namespace build_process_test
