// The mesh field against brute force over all triangles.
#include "engine/mesh/mesh_field.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/field/slice_context.h"
#include "engine/mesh/triangle_tree.h"
#include "engine/solids/csg.h"
#include "engine/solids/shell.h"
#include "tests/engine/solids/shapes.h"

namespace mesh_field_test {

using namespace lamella;

namespace {

/// Generalised winding number as the sum of solid angles (van Oosterom and Strackee).
double solid_angle_winding(const TriangleMesh& mesh, dvec3 p) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double numerator = glm::dot(a, glm::cross(b, c));
        const double denominator =
            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        sum += 2 * std::atan2(numerator, denominator);
    }
    return sum / (4 * pi);
}

/// Nearest distance by dense sampling refined with the three edges: slow and simple.
double brute_distance(const TriangleMesh& mesh, dvec3 p) {
    double best = infinity;
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
        const dvec3 n = glm::normalize(glm::cross(b - a, c - a));
        const dvec3 foot = p - n * glm::dot(n, p - a);
        const bool in = glm::dot(glm::cross(b - a, foot - a), n) >= 0 &&
                        glm::dot(glm::cross(c - b, foot - b), n) >= 0 &&
                        glm::dot(glm::cross(a - c, foot - c), n) >= 0;
        if (in) best = std::min(best, glm::length(p - foot));
        for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
            const double s = std::clamp(glm::dot(p - u, v - u) / glm::dot(v - u, v - u), 0.0, 1.0);
            best = std::min(best, glm::length(p - (u + (v - u) * s)));
        }
    }
    return best;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b, bool turned_inside_out) {
    const auto offset = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (auto t : b.triangles) {
        if (turned_inside_out) std::swap(t[1], t[2]);
        a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    return a;
}

double section_area(const FieldPtr& field, double z) {
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    const RowBand band{Axis::x, -5, 0.02, -5, 0.02, 0, 500, 1, 0, 500};
    context.slice(*field, z).runs(band, scratch, rows);
    return static_cast<double>(rows.total_length()) / run_unit * 0.02 * 0.02;
}

}  // namespace

TEST_CASE("winding number and distance of a mesh equal brute force") {
    const TriangleMesh mesh = joined(joined(shapes::icosphere(2, 3), shapes::icosphere(1, 1), true),
                                     shapes::box({1, 1, 1}, {4, 4, 4}), false);
    const TriangleTree tree(mesh);
    const unsigned seed = 31;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-4.5, 4.5);
    for (int k = 0; k < 600; ++k) {
        const dvec3 p(at(random), at(random), at(random));
        REQUIRE(tree.winding(p) == static_cast<int>(std::lround(solid_angle_winding(mesh, p))));
        REQUIRE(tree.distance(p) == Approx(brute_distance(mesh, p)).margin(1e-12));
    }
}

TEST_CASE("nested shells are cavities, overlapping ones are one solid, wherever faces lie on the plane") {
    const FieldPtr hollow = make_mesh_field(shapes::closed(
        joined(shapes::box({-3, -3, -3}, {3, 3, 3}), shapes::box({-1, -1, -1}, {1, 1, 1}), true)));
    REQUIRE(section_area(hollow, 0) == Approx(36 - 4).epsilon(1e-3));
    REQUIRE(section_area(hollow, 2) == Approx(36).epsilon(1e-3));
    // Planes through faces: a vertex on the plane counts as above it, so a box is solid at its lower face
    // only.
    REQUIRE(section_area(hollow, -3) == Approx(0).margin(1e-9));
    REQUIRE(section_area(hollow, 3) == Approx(36).epsilon(1e-3));
    const FieldPtr overlap = make_mesh_field(shapes::closed(
        joined(shapes::box({-3, -3, -3}, {1, 3, 3}), shapes::box({-1, -3, -3}, {3, 3, 3}), false)));
    REQUIRE(section_area(overlap, 0.3) == Approx(36).epsilon(1e-3));
}

TEST_CASE("lines and planes through vertices and along edges give no streaks") {
    const FieldPtr box = make_mesh_field(shapes::closed(shapes::box({-2, -2, -2}, {2, 2, 2})));
    SliceContext context;
    Scratch scratch;
    for (const Axis axis : {Axis::x, Axis::y}) {
        // Lines at whole millimetres: some lie exactly on the box's faces.
        RowBand band{axis, -5, 0.25, -5.5, 1, 0, 11, 1, 0, 40};
        RunRows rows;
        context.slice(*box, 0).runs(band, scratch, rows);
        for (int l = 0; l < band.lines(); ++l) {
            const double v = band.line(l);
            const auto line = rows.line(static_cast<std::size_t>(l));
            if (std::abs(v) < 2) REQUIRE((line.size() == 1 && line[0] == Run{12 * 256, 28 * 256}));
            if (std::abs(v) > 2) REQUIRE(line.empty());
        }
    }
}

TEST_CASE("a grown mesh is everything within the distance, reflex edges and thin parts included") {
    const unsigned seed = 32;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-3.5, 3.5);
    const std::vector<TriangleMesh> meshes = {
        shapes::icosphere(2, 2.5), shapes::l_prism(), shapes::box({-2, -2, -0.2}, {2, 2, 0.2}),
        joined(shapes::box({-3, -3, -3}, {3, 3, 3}), shapes::icosphere(2, 1.7), true)};
    Scratch scratch;
    for (const TriangleMesh& mesh : meshes) {
        const FieldPtr body = make_mesh_field(shapes::closed(mesh));
        for (const double t : {0.15, 0.6}) {
            const FieldPtr skin = make_intersection({body, make_shell(body, t)});
            const FieldPtr core = make_offset(body, -t), fat = make_offset(body, t);
            for (int round = 0; round < 12; ++round) {
                const double z = at(random) * 0.8;
                SliceContext context;
                const RowBand band{Axis::x, -4, 0.04, -4, 0.31, 0, 26, 1, 0, 200};
                RunRows in_skin, in_core, in_fat;
                context.slice(*skin, z).runs(band, scratch, in_skin);
                context.slice(*core, z).runs(band, scratch, in_core);
                context.slice(*fat, z).runs(band, scratch, in_fat);
                const auto solid = [&](const RunRows& rows, int l, double u) {
                    for (const Run& run : rows.line(static_cast<std::size_t>(l))) {
                        if (run.begin <= u && u < run.end) return true;
                    }
                    return false;
                };
                for (int k = 0; k < 300; ++k) {
                    const int l = static_cast<int>(random() % 26);
                    const double u = static_cast<double>(random() % (200 * 256)) + 0.5;
                    const dvec3 p(band.along(u), band.line(l), z);
                    const double d = brute_distance(mesh, p);
                    if (std::abs(d - t) < 2e-3 || d < 2e-3) continue;
                    const bool inside = std::lround(solid_angle_winding(mesh, p)) != 0;
                    INFO("t " << t << ", z " << z << ", line " << l << ", u " << u << ", distance " << d);
                    REQUIRE(solid(in_skin, l, u) == (inside && d < t));
                    REQUIRE(solid(in_core, l, u) == (inside && d > t));
                    REQUIRE(solid(in_fat, l, u) == (inside || d < t));
                }
            }
        }
    }
}

}  // namespace mesh_field_test
