// Frames: on the surface and on Voronoi faces, welded to the foam, in one piece with it on real models and
// where bodies are thin.
#include "procedural/foam/surface_frame.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "engine/surveys/island_survey.h"
#include "procedural/foam/closed_foam.h"
#include "procedural/foam/voronoi_foam.h"
#include "tests/engine/field/gradings.h"

namespace surface_frame_test {

using namespace lamella;

namespace {

const std::string models = std::string(LAMELLA_SOURCE_DIR) + "/";

FieldPtr model(const std::string& path, double scale = 1) {
    MeshFile file = read_mesh(models + path, MeshReadOptions{});
    for (dvec3& vertex : file.mesh.vertices) vertex *= scale;
    return make_mesh_field(close_mesh(std::move(file.mesh)));
}

FoamSettings framed(const FieldPtr& body, double cell, double beam, double frame) {
    FoamSettings settings;
    settings.cell = cell;
    settings.beam_radius = beam;
    settings.seed = 3;
    settings.region = body->bounds();
    settings.frame = FrameSettings{body, frame, true};
    return settings;
}

FoamSettings without_frame(FoamSettings settings) {
    settings.frame.reset();
    return settings;
}

/// Components of the body's foam, as the layers show it.
IslandReport survey(const FieldPtr& body, const FieldPtr& foam, double pitch) {
    Job job;
    job.part = make_filled_body(body, foam, 0);
    job.bounds = body->bounds();
    job.layers = equal_layers(job.bounds.size().z, pitch);
    IslandSurveyOptions options;
    options.pitch = pitch;
    return survey_islands(job, body, options).report;
}

/// Where a segment crosses the surface, by small steps and halving.
std::vector<dvec3> crossings(const Field& body, dvec3 a, dvec3 b) {
    std::vector<dvec3> found;
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        double lo = i / double(steps), hi = (i + 1) / double(steps);
        const bool inside = body.value(a + (b - a) * lo) < 0;
        if (inside == (body.value(a + (b - a) * hi) < 0)) continue;
        for (int k = 0; k < 40; ++k) {
            const double middle = 0.5 * (lo + hi);
            ((body.value(a + (b - a) * middle) < 0) == inside ? lo : hi) = middle;
        }
        found.push_back(a + (b - a) * lo);
    }
    return found;
}

double distance_to_segment(dvec3 p, const Beam& beam) {
    const dvec3 along = beam.b - beam.a;
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::min(std::max(glm::dot(p - beam.a, along) / square, 0.0), 1.0) : 0;
    return glm::distance(p, beam.a + along * t);
}

struct Weld {
    int crossings = 0, held = 0;
};

/// How many of the places where the bare foam's axes cross the surface lie within a frame beam's radius of
/// its axis.
Weld weld(const FieldPtr& body, const FoamSettings& settings) {
    const auto foam = make_voronoi_foam(settings), bare = make_voronoi_foam(without_frame(settings));
    const double frame_radius = settings.frame->radius->at(dvec3(0));
    Weld weld;
    for (const Beam& beam : bare->beams_touching(body->bounds())) {
        for (const dvec3& p : crossings(*body, beam.a, beam.b)) {
            ++weld.crossings;
            const auto near = foam->beams_touching(grown(Box{p, p}, 1e-3));
            weld.held += std::any_of(near.begin(), near.end(), [&](const Beam& piece) {
                return piece.ra == frame_radius && distance_to_segment(p, piece) <= frame_radius;
            });
        }
    }
    return weld;
}

}  // namespace

TEST_CASE("the frame's axes lie on the surface and halfway between seeds", "[surface_frame]") {
    const FieldPtr body = make_sphere({0.3, 0.1, -0.2}, 6);
    const FoamSettings settings = framed(body, 2, 0.15, 0.4);
    const auto foam = make_voronoi_foam(settings);
    const auto seeds = foam->seeds_in(grown(body->bounds(), 6));
    int frame = 0;
    for (const Beam& beam : foam->beams_touching(body->bounds())) {
        if (beam.ra != 0.4) continue;
        ++frame;
        for (const dvec3& p : {beam.a, beam.b}) {
            // Ends lie on the curve; joints, of which a ball needs none, would not.
            CHECK(std::abs(body->value(p)) < 2e-3);
            double first = infinity, second = infinity;
            for (const Seed& seed : seeds) {
                const double d = glm::distance(seed.position, p);
                if (d < first) {
                    second = first;
                    first = d;
                } else {
                    second = std::min(second, d);
                }
            }
            CHECK(second - first < 1e-6);
        }
    }
    CHECK(frame > 300);
}

TEST_CASE("foam beams end within the frame's radius of a frame beam", "[surface_frame]") {
    for (const auto& [path, scale, cell] : {std::tuple("examples/models/koala_mm.obj", 1.0, 5.0),
                                            std::tuple("tests/models/good/fish_mm.obj", 1.0, 4.0),
                                            std::tuple("tests/models/good/featuretype.stl", 10.0, 4.0)}) {
        INFO(path);
        const FieldPtr body = model(path, scale);
        const Weld found = weld(body, framed(body, cell, 0.25, 0.4));
        CHECK(found.crossings > 400);
        CHECK(found.held >= found.crossings * 0.999);
    }
}

TEST_CASE("foam and frame are in one piece on real models", "[surface_frame]") {
    for (const auto& [path, scale, cell] : {std::tuple("examples/models/koala_mm.obj", 1.0, 5.0),
                                            std::tuple("tests/models/good/fish_mm.obj", 1.0, 4.0),
                                            std::tuple("tests/models/good/featuretype.stl", 10.0, 4.0)}) {
        INFO(path);
        const FieldPtr body = model(path, scale);
        const IslandReport report = survey(body, make_voronoi_foam(framed(body, cell, 0.25, 0.4)), 0.1);
        CHECK(report.components == 1);
        CHECK(report.count == 0);
    }
}

TEST_CASE("the bare foam of a thin body is in pieces, and its frame joins them", "[surface_frame]") {
    // A rod and a bent one thinner than the cells, and a plate: faces cut the rods in loops that meet no
    // edge.
    const FieldPtr rod = make_cylinder({0.2, 0.1, -20}, {0.3, -0.2, 20}, 0.8);
    const FieldPtr ring = make_torus({0.3, 0.2, 0.1}, 14, 0.9);
    const FieldPtr plate = make_box({{-15, -15, 0.2}, {15, 15, 1.4}});
    for (const auto& [name, body] :
         {std::pair("rod", rod), std::pair("ring", ring), std::pair("plate", plate)}) {
        INFO(name);
        const FoamSettings settings = framed(body, 5, 0.2, 0.3);
        CHECK(survey(body, make_voronoi_foam(without_frame(settings)), 0.08).components > 1);
        const IslandReport report = survey(body, make_voronoi_foam(settings), 0.08);
        CHECK(report.components == 1);
    }
}

TEST_CASE("a piece of the body within one cell is not left empty", "[surface_frame]") {
    // Balls of a few sizes beside a large one, apart from each other; cells are larger than most.
    std::vector<FieldPtr> balls{make_sphere({0, 0, 0}, 9)};
    for (int i = 0; i < 12; ++i)
        balls.push_back(make_sphere({14 + 5 * (i % 4), 6 * (i / 4 - 1), i - 5}, 0.7 + 0.08 * i));
    const FieldPtr body = make_union(balls);
    const FoamSettings settings = framed(body, 6, 0.25, 0.3);
    CHECK(survey(body, make_voronoi_foam(without_frame(settings)), 0.08).bodies < balls.size());
    const IslandReport report = survey(body, make_voronoi_foam(settings), 0.08);
    CHECK(report.bodies == balls.size());
    CHECK(report.components == balls.size());
}

TEST_CASE("a frame without its foam is a lampshade", "[surface_frame]") {
    const FieldPtr body = make_sphere(dvec3(0), 10);
    FoamSettings settings = framed(body, 4, 0.2, 0.5);
    settings.frame->interior = false;
    const auto frame = make_voronoi_foam(settings);
    for (const Beam& beam : frame->beams_touching(body->bounds())) {
        CHECK(std::abs(body->value(beam.a)) < 0.01);
        CHECK(beam.ra == 0.5);
    }
    CHECK(survey(body, frame, 0.15).components == 1);
}

TEST_CASE("nothing is left of a foam outside its frame's body", "[surface_frame]") {
    const FieldPtr body = make_sphere(dvec3(0), 5);
    FoamSettings settings = framed(body, 2, 0.15, 0.3);
    settings.region = {dvec3(-9), dvec3(9)};
    const auto foam = make_voronoi_foam(settings);
    CHECK(foam->beams_touching({dvec3(5.4), dvec3(9)}).empty());
    for (const Beam& beam : foam->beams_touching(settings.region)) {
        CHECK(body->value(0.5 * (beam.a + beam.b)) < 0.01);
    }
}

TEST_CASE("a frame is never thinner than the foam, and its radius may vary", "[surface_frame]") {
    const FieldPtr body = make_box({dvec3(-8), dvec3(8)});
    FoamSettings settings = framed(body, 3, 0.3, 0.2);
    settings.frame->radius = std::make_shared<const Ramp>(-8, 0.1, 8, 0.6);
    const auto foam = make_voronoi_foam(settings);
    int thick = 0;
    for (const Beam& beam : foam->beams_touching(body->bounds())) {
        for (const auto& [p, r] : {std::pair(beam.a, beam.ra), std::pair(beam.b, beam.rb)}) {
            const double asked = std::max(0.3, 0.1 + 0.5 * std::min(std::max((p.x + 8) / 16, 0.0), 1.0));
            CHECK((std::abs(r - 0.3) < 1e-9 || std::abs(r - asked) < 0.03 * asked));
            thick += r > 0.5;
        }
    }
    CHECK(thick > 20);
}

TEST_CASE("a framed foam is the same from any box, and grows by an offset", "[surface_frame]") {
    const FieldPtr body = make_torus(dvec3(0), 7, 2.5);
    const FoamSettings settings = framed(body, 2.2, 0.15, 0.3);
    const auto whole = make_voronoi_foam(settings), parts = make_voronoi_foam(settings);
    const auto all = whole->beams_touching(body->bounds());
    for (const Box& box : {Box{{0, 0, 0}, {9, 9, 2}}, Box{{-9, -3, -2}, {-4, 4, 0}}}) {
        std::vector<Beam> expected;
        for (const Beam& beam : all) {
            if (touches(beam, box)) expected.push_back(beam);
        }
        CHECK(parts->beams_touching(box) == expected);
        CHECK(expected.size() > 50);
    }
    const FieldPtr thicker = whole->offset(0.1);
    for (const dvec3 p : {dvec3(7, 0, 2.7), dvec3(5, 4, 1), dvec3(-6, 1, 0.3)}) {
        CHECK(thicker->value(p) == Approx(whole->value(p) - 0.1).margin(1e-9));
    }
}

TEST_CASE("closed foams and Kelvin's have frames, too", "[surface_frame]") {
    const FieldPtr body = make_sphere({0.1, 0, 0.2}, 7);
    FoamSettings kelvin = framed(body, 3, 0.2, 0.35);
    kelvin.pattern = SeedPattern::bcc;
    CHECK(survey(body, make_voronoi_foam(kelvin), 0.1).components == 1);
    ClosedFoamSettings closed{framed(body, 3, 0.2, 0.35), 0.15, 0.5};
    CHECK(survey(body, make_closed_foam(closed), 0.1).components == 1);
}

TEST_CASE("a frame's radius must be a length", "[surface_frame]") {
    const FieldPtr body = make_sphere(dvec3(0), 5);
    CHECK_THROWS_WITH(make_voronoi_foam(framed(body, 2, 0.2, 0)),
                      Catch::Contains("the frame's beam radius is 0 mm"));
}

}  // namespace surface_frame_test
