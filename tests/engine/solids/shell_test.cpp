// Graded skins against dense samples of the surface, and their runs against their values.
#include "engine/solids/shell.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/field/gradings.h"
#include "tests/engine/solids/shapes.h"

namespace shell_test {

using namespace lamella;

namespace {

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    return a;
}

/// A body of which every corner, a cave and a ridge are sharp: a star prism.
TriangleMesh star_prism() {
    TriangleMesh mesh;
    constexpr std::uint32_t n = 10;
    for (const double z : {-1.5, 1.5}) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const double a = 2 * 3.14159265358979 * k / n, r = k % 2 == 0 ? 3.0 : 1.2;
            mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
        }
    }
    mesh.vertices.push_back({0, 0, -1.5});
    mesh.vertices.push_back({0, 0, 1.5});
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t next = (k + 1) % n;
        mesh.triangles.push_back({k, next, next + n});
        mesh.triangles.push_back({k, next + n, k + n});
        mesh.triangles.push_back({next, k, 2 * n});
        mesh.triangles.push_back({k + n, next + n, 2 * n + 1});
    }
    return mesh;
}

struct Sample {
    dvec3 place;
    double radius;
};

/// Points all over a mesh, at most `spacing` apart, with the thickness asked for there.
std::vector<Sample> samples_of(const TriangleMesh& mesh, const Grading& thickness, double spacing) {
    std::vector<Sample> samples;
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        const double longest = std::max(glm::length(b - a), std::max(glm::length(c - b), glm::length(a - c)));
        const int n = static_cast<int>(std::ceil(longest / spacing));
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; i + j <= n; ++j) {
                const dvec3 p =
                    a + (b - a) * (i / static_cast<double>(n)) + (c - a) * (j / static_cast<double>(n));
                samples.push_back({p, thickness.at(p)});
            }
        }
    }
    return samples;
}

/// The least of |p - x| - r(x) over the samples, where a radius of 0 makes no skin.
double brute_value(const std::vector<Sample>& samples, dvec3 p) {
    double least = infinity;
    for (const Sample& s : samples) {
        if (s.radius > 0) least = std::min(least, glm::length(p - s.place) - s.radius);
    }
    return least;
}

bool solid_at(const RunRows& rows, int line, double u) {
    for (const Run& run : rows.line(static_cast<std::size_t>(line))) {
        if (run.begin <= u && u < run.end) return true;
    }
    return false;
}

std::vector<TriangleMesh> meshes() {
    return {shapes::icosphere(2, 2.5), shapes::l_prism(), shapes::box({-3, -2.5, -2}, {3, 2.5, 2}),
            shapes::box({-3, -3, -0.2}, {3, 3, 0.2}), star_prism(),
            // Two plates with a gap that the thick skin of one is far wider than.
            joined(shapes::box({-3, -2.5, -2}, {-0.6, 2.5, 2}), shapes::box({-0.5, -2.5, -2}, {3, 2.5, 2}))};
}

/// Slopes, valleys and ridges of all steepnesses, thicknesses that end, and a step.
std::vector<GradingPtr> thicknesses() {
    return {
        steady_function([](dvec3 p) { return 0.6 + 0.15 * p.x; }, 0.15),
        steady_function([](dvec3 p) { return 0.2 + 0.3 * std::abs(p.y + 0.3) + 0.2 * std::abs(p.z); }, 0.4),
        steady_function([](dvec3 p) { return std::max(0.0, 1.2 - 0.7 * glm::length(p - dvec3(1, 1, 1))); },
                        0.7),
        steady_function([](dvec3 p) { return std::max(0.0, 0.25 * p.x); }, 0.25),
        steady_function([](dvec3 p) { return std::min(1.5, std::max(0.1, 0.4 - 1.6 * (p.x + 0.4))); }, 1.6),
        steady_function([](dvec3 p) { return p.x + 0.2 * p.z < 0.1 ? 0.9 : 0.2; }, 1e9),
    };
}

constexpr Interval wide{0, 5};

}  // namespace

TEST_CASE("a graded skin is everything inside within the thickness asked for at the surface") {
    std::mt19937 random(61);
    std::uniform_real_distribution<double> at(-3, 3);
    int skin = 0, core = 0;
    for (const TriangleMesh& mesh : meshes()) {
        const FieldPtr body = make_mesh_field(shapes::closed(mesh));
        for (const GradingPtr& thickness : thicknesses()) {
            constexpr double spacing = 0.06;
            const auto samples = samples_of(mesh, *thickness, spacing);
            const FieldPtr shell = make_intersection({body, make_shell(body, thickness, wide)});
            for (int k = 0; k < 250; ++k) {
                const dvec3 p(at(random), at(random), at(random) * 0.7);
                if (!(body->value(p) < -0.01)) continue;
                // The samples miss up to their spacing, and steps are followed to a quarter of the thickness.
                const double v = brute_value(samples, p);
                if (std::abs(v) < 0.3) continue;
                REQUIRE((shell->value(p) < 0) == (v < 0));
                (v < 0 ? skin : core) += 1;
            }
        }
    }
    CHECK(skin > 300);
    CHECK(core > 300);
}

TEST_CASE("a graded outer skin is everything outside within the thickness asked for at the surface") {
    std::mt19937 random(64);
    std::uniform_real_distribution<double> at(-4.5, 4.5);
    int skin = 0, air = 0;
    for (const TriangleMesh& mesh : meshes()) {
        const FieldPtr body = make_mesh_field(shapes::closed(mesh));
        for (const GradingPtr& thickness : thicknesses()) {
            const auto samples = samples_of(mesh, *thickness, 0.06);
            const FieldPtr part = make_filled_body(body, nullptr, thickness, wide, SkinSide::outside);
            for (int k = 0; k < 250; ++k) {
                const dvec3 p(at(random), at(random), at(random) * 0.7);
                if (!(body->value(p) > 0.01)) continue;
                const double v = brute_value(samples, p);
                if (std::abs(v) < 0.3) continue;
                REQUIRE((part->value(p) < 0) == (v < 0));
                if (v < 0) REQUIRE(part->bounds().contains(p));
                (v < 0 ? skin : air) += 1;
            }
        }
    }
    CHECK(skin > 300);
    CHECK(air > 300);
}

TEST_CASE("where the thickness varies gently a graded skin is right to two percent") {
    std::mt19937 random(62);
    std::uniform_real_distribution<double> at(-3, 3);
    int checked = 0;
    for (const TriangleMesh& mesh : meshes()) {
        const FieldPtr body = make_mesh_field(shapes::closed(mesh));
        for (const GradingPtr& thickness : {thicknesses()[0], thicknesses()[1]}) {
            constexpr double spacing = 0.04;
            const auto samples = samples_of(mesh, *thickness, spacing);
            const FieldPtr shell = make_shell(body, thickness, wide);
            for (int k = 0; k < 250; ++k) {
                const dvec3 p(at(random), at(random), at(random) * 0.7);
                if (!(body->value(p) < 0)) continue;
                ++checked;
                const double v = brute_value(samples, p), got = shell->value(p);
                // At most the samples' half spacing above, where the surface is not met, and never below but
                // for the two percent.
                REQUIRE(got <= v + 0.03);
                REQUIRE(got >= v - 0.03 - 1.5 * 0.7 * spacing);
            }
        }
    }
    CHECK(checked > 500);
}

TEST_CASE("the runs of a graded skin are solid exactly where its value is negative") {
    std::mt19937 random(63);
    std::uniform_real_distribution<double> height(-1.9, 1.9);
    Scratch scratch;
    int solid = 0, hollow = 0;
    for (const TriangleMesh& mesh : meshes()) {
        for (const bool oriented : {true, false}) {
            SolidMesh closed = shapes::closed(mesh);
            closed.oriented_manifold = oriented;
            const FieldPtr body = make_mesh_field(closed);
            int number = 0;
            for (const GradingPtr& thickness : thicknesses()) {
                const FieldPtr skin = make_intersection({body, make_shell(body, thickness, wide)});
                INFO("mesh of " << mesh.triangles.size() << " triangles, thickness " << number++);
                for (int round = 0; round < 4; ++round) {
                    const double z = height(random);
                    SliceContext context;
                    const RowBand band{
                        round % 2 == 0 ? Axis::x : Axis::y, -4, 0.04, -4, 0.31, 0, 26, 1, 0, 200};
                    RunRows rows;
                    context.slice(*skin, z).runs(band, scratch, rows);
                    for (int k = 0; k < 400; ++k) {
                        const int l = static_cast<int>(random() % 26);
                        const double u = static_cast<double>(random() % 51200) + 0.5;
                        const double along = band.along(u), across = band.line(l);
                        const dvec3 p =
                            band.axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z);
                        const double v = skin->value(p);
                        if (std::abs(v) < 1e-3) continue;
                        INFO("oriented " << oriented << ", " << p.x << ", " << p.y << ", " << p.z
                                         << ", value " << v);
                        REQUIRE(solid_at(rows, l, u) == (v < 0));
                        if (body->value(p) < 0) (v < 0 ? solid : hollow) += 1;
                    }
                }
            }
        }
    }
    CHECK(solid > 3000);
    CHECK(hollow > 3000);
}

TEST_CASE("the runs of a skin on any side are solid exactly where its value is negative") {
    std::mt19937 random(65);
    std::uniform_real_distribution<double> height(-2.6, 2.6);
    Scratch scratch;
    int solid = 0, hollow = 0;
    for (const TriangleMesh& mesh : meshes()) {
        const FieldPtr body = make_mesh_field(shapes::closed(mesh)),
                       filling = make_sphere({0.4, 0, 0.2}, 1.1);
        for (const SkinSide side : {SkinSide::outside, SkinSide::centred}) {
            std::vector<FieldPtr> parts{make_filled_body(body, filling, 0.37, side)};
            for (const GradingPtr& thickness : thicknesses())
                parts.push_back(make_filled_body(body, filling, thickness, wide, side));
            for (const FieldPtr& part : parts) {
                const double z = height(random);
                SliceContext context;
                const RowBand band{Axis::x, -6, 0.04, -6, 0.31, 0, 38, 1, 0, 300};
                RunRows rows;
                context.slice(*part, z).runs(band, scratch, rows);
                for (int k = 0; k < 120; ++k) {
                    const int l = static_cast<int>(random() % 38);
                    const double u = static_cast<double>(random() % 76800) + 0.5;
                    const dvec3 p(band.along(u), band.line(l), z);
                    const double v = part->value(p);
                    if (std::abs(v) < 1e-3) continue;
                    INFO(p.x << ", " << p.y << ", " << p.z << ", value " << v);
                    REQUIRE(solid_at(rows, l, u) == (v < 0));
                    (v < 0 ? solid : hollow) += 1;
                }
            }
        }
    }
    CHECK(solid > 500);
    CHECK(hollow > 2000);
}

TEST_CASE("skins of a ball lie inside, outside or half and half") {
    const FieldPtr ball = make_sphere({0, 0, 0}, 4), core = make_sphere({0, 0, 0}, 1);
    const GradingPtr gently = steady_function([](dvec3 p) { return 1 + 0.1 * p.x; }, 0.1);
    struct Case {
        SkinSide side;
        double inner, outer;  // shares of the thickness
    };
    for (const Case c :
         {Case{SkinSide::inside, 1, 0}, Case{SkinSide::outside, 0, 1}, Case{SkinSide::centred, 0.5, 0.5}}) {
        const FieldPtr constant = make_filled_body(ball, core, 0.8, c.side);
        const FieldPtr graded = make_filled_body(ball, core, gently, {0, 100}, c.side);
        const FieldPtr hollow = make_filled_body(ball, nullptr, 0.8, c.side);
        for (double x = -5.95; x < 6; x += 0.1) {
            const double r = std::abs(x), t = 1 + 0.1 * x;
            const auto skin = [&](double thickness) {
                return r > 4 - c.inner * thickness && r < 4 + c.outer * thickness;
            };
            INFO("x " << x << ", side " << static_cast<int>(c.side));
            CHECK((constant->value({x, 0, 0}) < 0) == (r < 1 || skin(0.8)));
            CHECK((graded->value({x, 0, 0}) < 0) == (r < 1 || skin(t)));
            CHECK((hollow->value({x, 0, 0}) < 0) == skin(0.8));
        }
        CHECK(constant->bounds().hi.z == Approx(4 + 0.8 * c.outer));
        // Solid at x = r only where r < 4 + outer (1 + 0.1 r); the box may be loose by the search's 2 %.
        CHECK(graded->bounds().hi.x >= (4 + c.outer) / (1 - 0.1 * c.outer) - 1e-9);
        CHECK(graded->bounds().hi.x < 1.05 * (4 + c.outer) / (1 - 0.1 * c.outer));
    }
}

TEST_CASE("a skin outside a mesh is the mesh grown less the mesh, its seam closed") {
    const FieldPtr body = make_mesh_field(shapes::closed(star_prism()));
    const FieldPtr block = make_box({dvec3(-9), dvec3(9)});
    const FieldPtr filled = make_filled_body(body, block, 0.5, SkinSide::outside);
    const FieldPtr centred = make_filled_body(body, block, 0.5, SkinSide::centred);
    Scratch scratch;
    const RowBand band{Axis::x, -6, 0.04, -6, 0.05, 0, 240, 1, 0, 300};
    for (const double z : {-1.9, -1.5, 0.1, 1.4, 1.7}) {
        for (const auto& [field, by] : {std::pair(filled, 0.5), std::pair(centred, 0.25)}) {
            RunRows expected, got;
            SliceContext context;
            context.slice(*make_offset(body, by), z).runs(band, scratch, expected);
            context.slice(*field, z).runs(band, scratch, got);
            REQUIRE(got == expected);
        }
    }
}

TEST_CASE("a skin of a constant thickness takes the constant path, to the bit") {
    const FieldPtr body = make_mesh_field(shapes::closed(shapes::l_prism()));
    const FieldPtr plain = make_shell(body, 0.4);
    const FieldPtr graded = make_shell(body, make_constant_grading(0.4), {0, 1});
    const FieldPtr clamped = make_shell(body, thicknesses()[0], {0.4, 0.4});
    Scratch scratch;
    for (const double z : {-0.8, 0.1, 0.77}) {
        const RowBand band{Axis::x, -4, 0.04, -4, 0.05, 0, 160, 1, 0, 200};
        RunRows expected, got;
        SliceContext context;
        context.slice(*plain, z).runs(band, scratch, expected);
        REQUIRE(!expected.runs().empty());
        for (const FieldPtr& field : {graded, clamped}) {
            context.slice(*field, z).runs(band, scratch, got);
            REQUIRE(got == expected);
            REQUIRE(field->value({0.3, 0.2, z}) == plain->value({0.3, 0.2, z}));
        }
    }
}

TEST_CASE("a graded skin of a ball is thick where it is told to be") {
    const FieldPtr ball = make_sphere({0, 0, 0}, 4);
    const GradingPtr thickness = steady_function([](dvec3 p) { return 1 + 0.2 * p.x; }, 0.2);
    const FieldPtr skin = make_intersection({ball, make_shell(ball, thickness, {0.5, 1.5})});
    // Along x: at x the thickness is 1 + 0.2 x within limits, and the depth 4 - |x|.
    for (double x = -3.95; x < 3.95; x += 0.1) {
        const double asked = std::min(1.5, std::max(0.5, 1 + 0.2 * x));
        CHECK((skin->value({x, 0, 0}) < 0) == (4 - std::abs(x) < asked));
    }
}

TEST_CASE("a thickness of nothing makes no skin, and a filled body is its filling there") {
    const FieldPtr body = make_mesh_field(shapes::closed(shapes::icosphere(2, 2.5)));
    const FieldPtr none = make_shell(body, make_constant_grading(-1), wide);
    CHECK(!(none->value({2.4, 0, 0}) < 0));
    const FieldPtr filling = make_sphere({0, 0, 0}, 1);
    const FieldPtr filled = make_filled_body(body, filling, make_constant_grading(0), wide);
    CHECK(filled->value({0.5, 0, 0}) < 0);
    CHECK(!(filled->value({2.3, 0, 0}) < 0));
    const GradingPtr right = steady_function([](dvec3 p) { return p.x > 0 ? 0.5 : 0.0; }, 1e9);
    const FieldPtr half = make_filled_body(body, filling, right, wide);
    CHECK(half->value({2.2, 0.1, 0.1}) < 0);
    CHECK(!(half->value({-2.2, 0.1, 0.1}) < 0));
    CHECK(half->value({-0.5, 0, 0}) < 0);
    const FieldPtr hollow = make_filled_body(body, nullptr, right, wide);
    CHECK(hollow->value({2.2, 0.1, 0.1}) < 0);
    CHECK(!(hollow->value({0.5, 0, 0}) < 0));
}

TEST_CASE("a body filled under a graded skin has the value of the union of both within it") {
    std::mt19937 random(71);
    std::uniform_real_distribution<double> place(-3.5, 3.5);
    const FieldPtr filling = make_sphere({0.4, 0, 0.2}, 1.1);
    int by_skin = 0, by_filling = 0;
    for (const TriangleMesh& mesh : meshes()) {
        const FieldPtr body = make_mesh_field(shapes::closed(mesh));
        for (const GradingPtr& thickness : thicknesses()) {
            const FieldPtr filled = make_filled_body(body, filling, thickness, wide);
            const FieldPtr skin = make_shell(body, thickness, wide);
            const FieldPtr reference = make_intersection({body, make_union({filling, skin})});
            for (int i = 0; i < 200; ++i) {
                const dvec3 p = dvec3(place(random), place(random), place(random)) * (i % 2 ? 1.0 : 0.4);
                const double v = reference->value(p), f = filling->value(p);
                CHECK(filled->value(p) == Approx(v).margin(1e-12));
                by_skin += v < 0 && f > 0;
                by_filling += v < 0 && v == f;
            }
        }
    }
    CHECK(by_skin > 500);
    CHECK(by_filling > 100);
}

TEST_CASE("graded skins that cannot be are refused") {
    const FieldPtr body = make_sphere({0, 0, 0}, 2);
    const GradingPtr one = make_constant_grading(1);
    CHECK_THROWS_AS(make_shell(body, one, {-1, 1}), InputError);
    CHECK_THROWS_AS(make_shell(body, one, {2, 1}), InputError);
    CHECK_THROWS_AS(make_shell(body, one, {0, 0}), InputError);
    CHECK_THROWS_AS(make_shell(body, one, {0, infinity}), InputError);
    CHECK_THROWS_AS(make_shell(body, nullptr, {0, 1}), InputError);
    CHECK_THROWS_AS(make_filled_body(body, nullptr, make_constant_grading(0), wide), InputError);
    const FieldPtr blend = make_smooth_union(body, body, 0.5);
    CHECK_THROWS_AS(make_shell(blend, thicknesses()[0], {0, 1}), InputError);
    CHECK_THROWS_AS(make_outer_shell(blend, 0.5), InputError);
    CHECK_THROWS_AS(make_outer_shell(blend, thicknesses()[0], {0, 1}), InputError);
    CHECK_THROWS_AS(make_outer_shell(body, NAN), InputError);
    CHECK_THROWS_AS(make_outer_shell(body, 0), InputError);
}

}  // namespace shell_test
