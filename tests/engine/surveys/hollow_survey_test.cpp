// Cavities of solids with known ones: their volumes, their walls, their roofs.
#include "engine/surveys/hollow_survey.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/morphology/bonding.h"
#include "tests/engine/surveys/island_scenes.h"

namespace hollow_survey_test {

using namespace lamella;

namespace {

constexpr double height = 0.2;
constexpr double off = 0.2236067977499790;  // of a row's pitch, 0.1 mm, and a layer

/// Roofs of 45 degrees.
HollowOptions options_of(double wall, double pitch = 0.1) {
    HollowOptions options;
    options.wall = wall;
    options.step = 0.2;
    options.bead = 0.4;
    options.pitch = pitch;
    options.threads = 2;
    return options;
}

Job job_of(const FieldPtr& part) { return scenes::job_of(part, part->bounds(), height); }

/// The cavities of each layer of a plan as rows.
std::vector<RunRows> layers_of(const RunBoxes& plan, int layers, int lines) {
    std::vector<RunRows> stack;
    auto at = plan.runs().begin();
    for (int i = 0; i < layers; ++i) {
        RunRows rows;
        for (int l = 0; l < lines; ++l) {
            for (; at != plan.runs().end() && at->layer == i && at->row == l; ++at)
                rows.push(at->begin, at->end);
            rows.end_line();
        }
        stack.push_back(rows);
    }
    REQUIRE(at == plan.runs().end());
    return stack;
}

/// Every roof is held from the layer below, and nowhere is the wall too thin.
void check_printable(const Job& job, const HollowOptions& options, const HollowSurvey& survey) {
    const int at_once = options.layers_at_once;
    const auto lines = static_cast<int>(job.bounds.size().y / options.pitch) + 1;
    const auto stack = layers_of(*survey.cavities, (job.layers.count() + at_once - 1) / at_once + 1, lines);
    REQUIRE(stack.back().runs().empty());
    const double unit = options.pitch / run_unit;
    for (std::size_t i = 0; i + 1 < stack.size(); ++i) {
        const double furthest = test::furthest_overhang(stack[i], stack[i + 1], run_unit) * unit;
        INFO("layer " << i);
        REQUIRE(furthest <= options.step * at_once + 2 * unit);
    }
    std::size_t k = 0;
    for (const PlacedRun& run : survey.cavities->runs()) {
        if (++k % 7 != 0) continue;
        const Box box = survey.cavities->grid().box(run);
        for (int c = 0; c < 8; ++c) {
            const dvec3 p((c & 1) != 0 ? box.hi.x : box.lo.x, (c & 2) != 0 ? box.hi.y : box.lo.y,
                          (c & 4) != 0 ? box.hi.z : box.lo.z);
            REQUIRE(job.part->value(p) <= -options.wall + 1e-6 + 2 * unit);
        }
    }
}

}  // namespace

TEST_CASE("a box is hollow up to a hip roof", "[enclosure]") {
    for (const dvec3 size : {dvec3(16, 16, 16), dvec3(30, 14, 12), dvec3(12, 26, 18)}) {
        const FieldPtr part = make_box({dvec3(0), size});
        const HollowOptions options = options_of(1.6);
        const HollowSurvey survey = hollow_out(job_of(part), options);
        check_printable(job_of(part), options, survey);
        REQUIRE(survey.count == 1);
        REQUIRE(survey.part_volume == Approx(size.x * size.y * size.z).epsilon(0.02));
        const auto hollow = [](dvec3 inner) {
            const double a = std::max(inner.x, inner.y), b = std::min(inner.x, inner.y), roof = b / 2;
            return a * b * (inner.z - roof) + b * roof / 2 * (a - b) + b * b * roof / 3;
        };
        const dvec3 inner = size - 2 * 1.6;
        REQUIRE(survey.volume < hollow(inner));
        REQUIRE(survey.volume > hollow(inner - 2.0 * (off + dvec3(0, 0.1, 0.2))));
    }
}

TEST_CASE("a ball and a lying cylinder are hollow below a cone and a ridge", "[enclosure]") {
    const HollowOptions options = options_of(1);
    const double r = 7;
    {
        const FieldPtr part = make_sphere({0, 0, 0}, r + 1);
        const HollowSurvey survey = hollow_out(job_of(part), options);
        check_printable(job_of(part), options, survey);
        // Half a ball under a cone of 45 degrees.
        REQUIRE(survey.volume < pi * r * r * r);
        REQUIRE(survey.volume > pi * std::pow(r - 2 * off, 3));
    }
    {
        const FieldPtr part = make_cylinder({-10, 0, 0}, {10, 0, 0}, r + 1);
        const HollowSurvey survey = hollow_out(job_of(part), options);
        check_printable(job_of(part), options, survey);
        // Half a disc under a triangle, 18 mm long.
        REQUIRE(survey.volume < (pi / 2 + 1) * r * r * 18);
        REQUIRE(survey.volume > (pi / 2 + 1) * std::pow(r - 2 * off, 2) * (18 - 4 * off));
    }
}

TEST_CASE("thicker walls and lesser steps leave less hollow", "[enclosure]") {
    const FieldPtr part =
        make_difference(make_box({{0, 0, 0}, {20, 16, 12}}, 2), make_sphere({10, 8, 12}, 4));
    double last = infinity;
    for (const double wall : {0.8, 1.2, 2.0, 3.0, 4.5}) {
        const double volume = hollow_out(job_of(part), options_of(wall)).volume;
        REQUIRE(volume < last);
        last = volume;
    }
    last = 0;
    for (const double step : {0.1, 0.15, 0.2, 0.3, 0.5}) {
        HollowOptions options = options_of(1.2);
        options.step = step;
        const double volume = hollow_out(job_of(part), options).volume;
        REQUIRE(volume > last);
        last = volume;
    }
}

TEST_CASE("chambers let a flat part be hollow, and walls stand between them", "[enclosure]") {
    const FieldPtr part = make_box({{0, 0, 0}, {24, 24, 6}});
    HollowOptions options = options_of(1.2);
    const double undivided = hollow_out(job_of(part), options).volume;
    options.chamber = 5;
    const HollowSurvey survey = hollow_out(job_of(part), options);
    check_printable(job_of(part), options, survey);
    // The middles of walls are 5.4 mm apart, one of them in the middle: three within 21.6 mm each way.
    REQUIRE(survey.count == 16);
    REQUIRE(survey.volume > 2 * undivided);
    const FieldPtr hollow = make_box_solid(survey.cavities);
    for (double t = -0.15; t < 0.2; t += 0.05) {
        for (double s = 2; s < 22; s += 0.7) {
            REQUIRE(hollow->value({12 + t, s, 2}) > 0);
            REQUIRE(hollow->value({s, 12 + 5.4 + t, 2}) > 0);
        }
    }
    REQUIRE(hollow->value({12 + 2.7, 12 + 2.7, 2}) < 0);
}

TEST_CASE("cavities that are too small or too narrow are left solid", "[enclosure]") {
    const FieldPtr part =
        make_union({make_box({{0, 0, 0}, {10, 10, 10}}), make_box({{20, 0, 0}, {26, 6, 10}}),
                    make_box({{30, 0, 0}, {32.6, 10, 10}})});
    HollowOptions options = options_of(1);
    // The last one's inside is less than a bead wide.
    options.bead = 0.7;
    const HollowSurvey all = hollow_out(job_of(part), options);
    REQUIRE(all.count == 2);
    options.min_volume = 100;
    const HollowSurvey large = hollow_out(job_of(part), options);
    REQUIRE(large.count == 1);
    REQUIRE(large.left_solid == 1);
    const FieldPtr hollow = make_box_solid(large.cavities);
    REQUIRE(hollow->value({5, 5, 2}) < 0);
    REQUIRE(hollow->value({23, 3, 2}) > 0);
    options.min_volume = 1e6;
    REQUIRE(hollow_out(job_of(part), options).cavities->empty());
}

TEST_CASE("layers taken at once have steps at once", "[enclosure]") {
    const FieldPtr part = make_sphere({0, 0, 0}, 5);
    Job job = scenes::job_of(part, part->bounds(), 0.05);
    HollowOptions options = options_of(0.8, 0.1);
    options.step = 0.05;
    options.layers_at_once = 4;
    const HollowSurvey survey = hollow_out(job, options);
    check_printable(job, options, survey);
    REQUIRE(survey.cavities->grid().layer_height == Approx(0.2));
    REQUIRE(survey.volume > pi * std::pow(4.2 - 2 * off, 3));
    REQUIRE(survey.volume < pi * std::pow(4.2, 3));
}

TEST_CASE("a model's cavities print, and are the same by any number of threads", "[enclosure]") {
    MeshFile file = read_mesh(LAMELLA_SOURCE_DIR "/tests/models/good/fish_mm.obj");
    const FieldPtr part = make_mesh_field(close_mesh(std::move(file.mesh)));
    const Job job = job_of(part);
    HollowOptions options = options_of(1.2, 0.2);
    const HollowSurvey survey = hollow_out(job, options);
    REQUIRE(survey.volume > 0.1 * survey.part_volume);
    check_printable(job, options, survey);
    options.threads = 1;
    REQUIRE(*hollow_out(job, options).cavities == *survey.cavities);
}

TEST_CASE("hollowing out refuses what makes no sense", "[enclosure]") {
    const Job job = job_of(make_sphere({0, 0, 0}, 5));
    const auto refused = [&](auto change) {
        HollowOptions options = options_of(1);
        change(options);
        REQUIRE_THROWS_AS(hollow_out(job, options), InputError);
    };
    refused([](HollowOptions& o) { o.wall = 0; });
    refused([](HollowOptions& o) { o.step = 0; });
    refused([](HollowOptions& o) { o.pitch = 0.21; });
    refused([](HollowOptions& o) { o.pitch = 0; });
    refused([](HollowOptions& o) { o.layers_at_once = 0; });
    refused([](HollowOptions& o) { o.min_volume = NAN; });
    refused([](HollowOptions& o) { o.max_bytes = 100000; });
    CancelToken cancel;
    cancel.cancel();
    HollowOptions options = options_of(1);
    options.cancel = &cancel;
    REQUIRE_THROWS_AS(hollow_out(job, options), Interrupted);
}

}  // namespace hollow_survey_test
