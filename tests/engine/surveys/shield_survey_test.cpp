// Shields: their distance from the print, their thickness, and that they stand on themselves.
#include "engine/surveys/shield_survey.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace shield_survey_test {

using namespace lamella;

namespace {

ShieldOptions options_of(double gap, double wall) {
    ShieldOptions options;
    options.gap = gap;
    options.wall = wall;
    options.step = 0.2;
    options.bead = 0.4;
    options.pitch = 0.1;
    options.threads = 2;
    return options;
}

Job job_of(const FieldPtr& part, double height = 0.2) { return scenes::job_of(part, part->bounds(), height); }

/// The volume of a plan's layer, mm^3.
double volume_at(const RunBoxes& plan, double z) {
    double sum = 0;
    for (const PlacedRun& run : plan.at(z)) {
        const dvec3 size = plan.grid().box(run).size();
        sum += size.x * size.y * size.z;
    }
    return sum;
}

}  // namespace

TEST_CASE("about a cylinder stands a ring", "[enclosure]") {
    const FieldPtr part = make_cylinder({0, 0, 0}, {0, 0, 10}, 6);
    const ShieldSurvey shield = make_shield(job_of(part), options_of(1.5, 0.8));
    const FieldPtr wall = make_box_solid(shield.wall);
    for (double z = 0.1; z < 10; z += 0.77) {
        for (int k = 0; k < 64; ++k) {
            const double a = 2 * pi * k / 64;
            const dvec3 way(std::cos(a), std::sin(a), 0);
            // Distances are off by two rows at most.
            REQUIRE(wall->value(way * 7.49 + dvec3(0, 0, z)) > 0);
            REQUIRE(wall->value(way * 8.0 + dvec3(0, 0, z)) < 0);
            REQUIRE(wall->value(way * 8.7 + dvec3(0, 0, z)) > 0);
        }
        const double inner = pi * 7.55 * 7.55, outer = pi * 8.4 * 8.4;
        REQUIRE(volume_at(*shield.wall, z) == Approx((outer - inner) * 0.2).epsilon(0.06));
    }
    REQUIRE(shield.wall->bounds().lo.z == Approx(0));
    REQUIRE(shield.wall->bounds().hi.z == Approx(10));
}

TEST_CASE("a shield keeps its gap to part and supports, and stands on itself", "[enclosure]") {
    const FieldPtr part = make_union({make_box({{-2, -2, 0}, {2, 2, 12}}),
                                      make_box({{-9, -3, 9}, {6, 3, 12}}), make_sphere({8, 4, 3}, 3)});
    Job job = job_of(part);
    job.supports = make_cylinder({-7, 0, 0}, {-7, 0, 9}, 1);
    const ShieldOptions options = options_of(1, 0.6);
    const ShieldSurvey shield = make_shield(job, options);
    const auto& plan = *shield.wall;
    const FieldPtr wall = make_box_solid(shield.wall);
    const FieldPtr print = make_union({part, job.supports});
    REQUIRE(shield.sweeps >= 2);
    std::size_t lowest = 0, k = 0, looked_at = 0, far = 0;
    for (const PlacedRun& run : plan.runs()) {
        const Box box = plan.grid().box(run);
        if (run.layer == 0) ++lowest;
        if (++k % 5 != 0) continue;
        // In the plane: walls lean over what ends below.
        for (const double x : {box.lo.x, box.center().x, box.hi.x}) {
            for (double a = 0; a < 2 * pi; a += pi / 8) {
                const dvec3 p(x, box.center().y, box.center().z);
                REQUIRE(print->value(p + dvec3(std::cos(a), std::sin(a), 0) * (options.gap - 0.01)) > 0);
            }
        }
        if (run.layer == 0) continue;
        // Below its middle, or a step to some side of that, is wall; at sharp corners 2.5 steps.
        bool held = false, near = false;
        for (double a = 0; a < 2 * pi; a += pi / 8) {
            for (const double reach : {0.0, 0.1, 0.2, 0.26, 0.35, 0.45, 0.56}) {
                const dvec3 p = box.center() + dvec3(std::cos(a) * reach, std::sin(a) * reach, -0.2);
                held = held || wall->value(p) < 0;
                near = near || (reach < 0.3 && held);
            }
        }
        REQUIRE(held);
        ++looked_at;
        far += near ? 0 : 1;
    }
    REQUIRE(far * 50 < looked_at);
    REQUIRE(lowest > 0);
}

TEST_CASE("a model's shield is the same by any number of threads", "[enclosure]") {
    MeshFile file = read_mesh(LAMELLA_SOURCE_DIR "/tests/models/good/fish_mm.obj");
    const FieldPtr part = make_mesh_field(close_mesh(std::move(file.mesh)));
    ShieldOptions options = options_of(1, 0.8);
    options.pitch = 0.2;
    const ShieldSurvey shield = make_shield(job_of(part), options);
    REQUIRE(shield.volume > 0);
    options.threads = 1;
    REQUIRE(*make_shield(job_of(part), options).wall == *shield.wall);
}

TEST_CASE("layers taken at once share their shield", "[enclosure]") {
    const FieldPtr part = make_cylinder({0, 0, 0}, {0, 0, 3}, 4);
    ShieldOptions options = options_of(1, 0.8);
    options.step = 0.05;
    options.layers_at_once = 4;
    const ShieldSurvey fine = make_shield(job_of(part, 0.05), options);
    REQUIRE(fine.wall->grid().layer_height == Approx(0.2));
    REQUIRE(fine.volume == Approx(make_shield(job_of(part), options_of(1, 0.8)).volume).epsilon(1e-6));
}

TEST_CASE("a shield refuses what makes no sense", "[enclosure]") {
    const Job job = job_of(make_sphere({0, 0, 0}, 5));
    const auto refused = [&](auto change) {
        ShieldOptions options = options_of(1, 0.8);
        change(options);
        REQUIRE_THROWS_AS(make_shield(job, options), InputError);
    };
    refused([](ShieldOptions& o) { o.gap = -1; });
    refused([](ShieldOptions& o) { o.wall = 0; });
    refused([](ShieldOptions& o) { o.step = NAN; });
    refused([](ShieldOptions& o) { o.pitch = 0.21; });
    refused([](ShieldOptions& o) { o.layers_at_once = 0; });
    refused([](ShieldOptions& o) { o.max_bytes = 100000; });
}

}  // namespace shield_survey_test
