// Meshes with corners at whole numbers, cut by planes and rows that fall on their faces, edges and diagonals:
// where rounding decides between neighbours, nothing may fall between them.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/contours/contours.h"
#include "engine/field/grading.h"
#include "engine/field/slice_context.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/mesh/triangle_tree.h"
#include "engine/mesh/triangulate.h"
#include "engine/morphology/in_plane_offset.h"
#include "engine/solids/csg.h"
#include "engine/solids/shell.h"
#include "tests/engine/field/gradings.h"

namespace lattice_aligned_test {

using namespace lamella;

namespace {

/// A prism over a polygon (counter-clockwise) from `low` to `high`, its axis turned to x, y or z.
struct Prism {
    std::vector<dvec2> polygon;
    double low = 0, high = 1;
    int axis = 2;

    dvec3 turned(dvec3 p) const {
        return axis == 2 ? p : axis == 1 ? dvec3(p.y, p.z, p.x) : dvec3(p.z, p.x, p.y);
    }
    dvec3 turned_back(dvec3 p) const {
        return axis == 2 ? p : axis == 1 ? dvec3(p.z, p.x, p.y) : dvec3(p.y, p.z, p.x);
    }
    bool holds(dvec3 point) const {
        const dvec3 p = turned_back(point);
        if (!(low < p.z && p.z < high)) return false;
        bool odd = false;
        for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
            const dvec2 a = polygon[i], b = polygon[j];
            if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)))
                odd = !odd;
        }
        return odd;
    }
};

/// A gear or star with corners at whole numbers, any number of them on a line.
std::vector<dvec2> random_polygon(std::mt19937& random) {
    std::uniform_int_distribution<int> corners(3, 12), reach(2, 7);
    for (;;) {
        const int n = corners(random);
        std::vector<dvec2> polygon;
        for (int i = 0; i < n; ++i) {
            const double angle = 6.283185307179586 * i / n, r = reach(random);
            const dvec2 p(std::round(r * std::cos(angle)), std::round(r * std::sin(angle)));
            if (polygon.empty() || p != polygon.back()) polygon.push_back(p);
        }
        if (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
        bool simple = polygon.size() >= 3;
        for (std::size_t i = 0; i < polygon.size() && simple; ++i) {
            const dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            simple = a.x * b.y - a.y * b.x > 0;  // seen from the origin, each corner is farther round
        }
        if (simple) return polygon;
    }
}

Prism random_prism(std::mt19937& random) {
    std::uniform_int_distribution<int> kind(0, 3), low(-4, 0), height(1, 8), side(1, 9), axis(0, 2);
    Prism prism;
    prism.axis = axis(random);
    prism.low = low(random);
    prism.high = prism.low + height(random);
    if (kind(random) == 0) {
        const double w = side(random), h = side(random);
        prism.polygon = {{-1, -2}, {w - 1, -2}, {w - 1, h - 2}, {-1, h - 2}};
    } else {
        prism.polygon = random_polygon(random);
    }
    return prism;
}

/// The mesh of a prism, each side cut along one of its diagonals by chance.
TriangleMesh mesh_of(const Prism& prism, std::mt19937& random) {
    TriangleMesh mesh;
    const auto n = static_cast<std::uint32_t>(prism.polygon.size());
    std::vector<dvec3> loop;
    for (const dvec2& p : prism.polygon) loop.emplace_back(p, 0.0);
    for (const double z : {prism.low, prism.high}) {
        for (const dvec2& p : prism.polygon) mesh.vertices.push_back(prism.turned(dvec3(p, z)));
    }
    std::vector<std::array<std::uint32_t, 3>> cap;
    triangulate_loop(loop, cap);
    for (const auto& t : cap) {
        mesh.triangles.push_back({t[0], t[2], t[1]});
        mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        if (random() % 2 == 0) {
            mesh.triangles.push_back({i, j, j + n});
            mesh.triangles.push_back({i, j + n, i + n});
        } else {
            mesh.triangles.push_back({i, j, i + n});
            mesh.triangles.push_back({j, j + n, i + n});
        }
    }
    return mesh;
}

double brute_distance(const TriangleMesh& mesh, dvec3 p) {
    double least = infinity;
    for (const auto& t : mesh.triangles) {
        least = std::min(
            least, closest_point(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]).distance);
    }
    return least;
}

/// Lines at all multiples of `across`, with points at odd multiples of `along` / 2 on them.
RowBand lines(Axis axis, double along, double across) {
    const int wide = static_cast<int>(12 / along), high = static_cast<int>(12 / across);
    return {axis, -wide * along, along, -(high + 0.5) * across, across, 0, 2 * high + 1, 1, 0, 2 * wide};
}

struct Counts {
    std::size_t judged = 0, solid = 0, wrong = 0;
};

/// Compares a slice with what it should hold: 1 solid, 0 void, -1 too near to a border to tell.
template <typename Truth>
void judge(const Field& field, double z, const RowBand& band, const Truth& truth, Counts& counts) {
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    context.slice(field, z).runs(band, scratch, rows);
    for (int l = 0; l < band.lines(); ++l) {
        for (int pixel = band.lo; pixel < band.hi; ++pixel) {
            const std::int32_t u = pixel * run_unit + run_unit / 2;
            const dvec2 p = band.axis == Axis::x ? dvec2(band.along(u), band.line(l))
                                                 : dvec2(band.line(l), band.along(u));
            const int expected = truth(dvec3(p, z));
            if (expected < 0) continue;
            bool found = false;
            for (const Run& run : rows.line(static_cast<std::size_t>(l)))
                found = found || (run.begin <= u && u < run.end);
            ++counts.judged;
            counts.solid += expected == 1;
            if (found == (expected == 1)) continue;
            ++counts.wrong;
            UNSCOPED_INFO("at " << p.x << ", " << p.y << ", " << z << ": " << found << " for " << expected);
        }
    }
}

constexpr double unsure = 1e-3;  // mm

/// Whether a skin holds a point; -1 near its borders.
int in_skin(const Prism& prism, const TriangleMesh& mesh, double inner, double outer, dvec3 p) {
    const double distance = brute_distance(mesh, p);
    const bool inside = prism.holds(p);
    const double reach = inside ? inner : outer;
    if (std::abs(distance - reach) < unsure || (distance < unsure && (inner == 0 || outer == 0))) return -1;
    return distance < reach ? 1 : 0;
}

}  // namespace

TEST_CASE("skins of meshes on whole numbers have no slit where rows and planes meet edges and diagonals",
          "[lattice]") {
    std::mt19937 random(390);
    Counts counts;
    const double thicknesses[] = {0.3, 0.5, 0.8, 1, 1.25};
    const double alongs[] = {0.25, 0.4, 0.7}, acrosses[] = {0.25, 0.5, 1};
    for (int round = 0; round < 400; ++round) {
        INFO("round " << round);
        const Prism prism = random_prism(random);
        const TriangleMesh mesh = mesh_of(prism, random);
        const FieldPtr body = make_mesh_field(close_mesh(mesh));
        const auto side = static_cast<SkinSide>(random() % 3);
        const double thickness = thicknesses[random() % 5];
        const double inner = side == SkinSide::inside    ? thickness
                             : side == SkinSide::outside ? 0
                                                         : thickness / 2;
        const FieldPtr skin = make_filled_body(body, nullptr, thickness, side);
        for (int cut = 0; cut < 2; ++cut) {
            const double z = 0.25 * static_cast<double>(static_cast<int>(random() % 41) - 20);
            const RowBand band =
                lines(random() % 2 == 0 ? Axis::x : Axis::y, alongs[random() % 3], acrosses[random() % 3]);
            judge(
                *skin, z, band, [&](dvec3 p) { return in_skin(prism, mesh, inner, thickness - inner, p); },
                counts);
        }
    }
    CHECK(counts.judged > 300'000);
    CHECK(counts.solid > 30'000);
    CHECK(counts.wrong == 0);
}

TEST_CASE("each layer of a hollow cube has the same area, however its faces are cut into triangles",
          "[lattice]") {
    std::mt19937 random(394);
    const double side = 20, thickness = 0.8, pitch = 0.1;
    const Prism prism{{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, 0, side, 2};
    const double wall = side * side - (side - 2 * thickness) * (side - 2 * thickness);
    for (int round = 0; round < 4; ++round) {
        const FieldPtr skin =
            make_filled_body(make_mesh_field(close_mesh(mesh_of(prism, random))), nullptr, thickness);
        const RowBand band{round % 2 == 0 ? Axis::x : Axis::y, -12, pitch, -12, pitch, 0, 240, 1, 0, 240};
        for (int layer = 8; layer < 192; ++layer) {
            SliceContext context;
            Scratch scratch;
            RunRows rows;
            context.slice(*skin, (layer + 0.5) * pitch).runs(band, scratch, rows);
            double units = 0;
            for (const Run& run : rows.runs()) units += run.end - run.begin;
            INFO("round " << round << ", layer " << layer);
            CHECK(units / run_unit * pitch * pitch == Approx(wall).epsilon(1e-9));
        }
    }
}

TEST_CASE("a skin whose thickness varies has no slit at edges and diagonals either", "[lattice]") {
    std::mt19937 random(391);
    Counts counts;
    for (int round = 0; round < 60; ++round) {
        INFO("round " << round);
        const Prism prism = random_prism(random);
        const TriangleMesh mesh = mesh_of(prism, random);
        const FieldPtr body = make_mesh_field(close_mesh(mesh));
        // Between the least and the greatest thickness the test has no opinion.
        const auto thickness = std::make_shared<const Ramp>(-10, 0.6, 10, 1);
        const FieldPtr skin = make_filled_body(body, nullptr, thickness, {0.6, 1});
        const double z = 0.25 * static_cast<double>(static_cast<int>(random() % 41) - 20);
        const RowBand band = lines(random() % 2 == 0 ? Axis::x : Axis::y, 0.25, 0.5);
        const auto truth = [&](dvec3 p) {
            const int thin = in_skin(prism, mesh, 0.6, 0, p), thick = in_skin(prism, mesh, 1, 0, p);
            return thin == thick ? thin : -1;
        };
        judge(*skin, z, band, truth, counts);
    }
    CHECK(counts.judged > 50'000);
    CHECK(counts.wrong == 0);
}

TEST_CASE("bodies that share a face are one, also in the rows and planes of that face", "[lattice]") {
    std::mt19937 random(392);
    Counts counts;
    for (int round = 0; round < 120; ++round) {
        INFO("round " << round);
        const Prism one = random_prism(random);
        Prism two = one;
        two.low = one.high;
        two.high = two.low + 3;
        const FieldPtr both = make_union({make_mesh_field(close_mesh(mesh_of(one, random))),
                                          make_mesh_field(close_mesh(mesh_of(two, random)))});
        Prism whole = one;
        whole.high = two.high;
        const TriangleMesh mesh = mesh_of(whole, random);
        const double z = one.axis == 2 && round % 2 == 0 ? one.high : static_cast<int>(random() % 9) - 4;
        const auto truth = [&](dvec3 p) {
            return brute_distance(mesh, p) < unsure ? -1 : whole.holds(p) ? 1 : 0;
        };
        judge(*both, z, lines(round % 4 < 2 ? Axis::x : Axis::y, 0.25, 0.5), truth, counts);
    }
    CHECK(counts.judged > 100'000);
    CHECK(counts.solid > 10'000);
    CHECK(counts.wrong == 0);
}

TEST_CASE("contours of skins on whole numbers enclose the area between the outline and its offset",
          "[lattice]") {
    std::mt19937 random(393);
    std::uniform_int_distribution<int> side(6, 24), layer(-3, 3);
    for (int round = 0; round < 40; ++round) {
        const double w = side(random), h = side(random), thickness = 0.8;
        const Prism prism{{{-1, -2}, {w - 1, -2}, {w - 1, h - 2}, {-1, h - 2}}, -12, 12, 2};
        const FieldPtr skin =
            make_filled_body(make_mesh_field(close_mesh(mesh_of(prism, random))), nullptr, thickness);
        SliceContext context;
        Scratch scratch;
        double area = 0;
        const std::vector<Contour> contours =
            trace_contours(context.slice(*skin, layer(random)), 0.02, scratch);
        for (const Contour& contour : contours) area += signed_area(contour.points);
        INFO("round " << round << ", " << w << " x " << h);
        CHECK(contours.size() == 2);
        CHECK(area == Approx(w * h - (w - 2 * thickness) * (h - 2 * thickness)).margin(0.01));
    }
}

TEST_CASE("outlines on whole numbers move by their offset, in rows on edges and corners too", "[lattice]") {
    std::mt19937 random(395);
    Counts counts;
    constexpr double tolerance = 0.02;  // mm
    const double offsets[] = {-0.75, -0.5, -0.25, 0.25, 0.5, 1};
    for (int round = 0; round < 90; ++round) {
        Prism prism = random_prism(random);
        prism.axis = 2;
        const double by = offsets[random() % 6];
        INFO("round " << round << ", by " << by);
        const FieldPtr body = make_mesh_field(close_mesh(mesh_of(prism, random)));
        const FieldPtr moved = make_in_plane_offset(body, {[by](double) { return by; }, {by, by}}, tolerance);
        const double z = prism.low + 0.25 * (1 + static_cast<int>(random() % 3));
        const auto from_outline = [&](dvec2 p) {
            double least = infinity;
            for (std::size_t i = 0, j = prism.polygon.size() - 1; i < prism.polygon.size(); j = i++) {
                const dvec2 a = prism.polygon[j], side = prism.polygon[i] - a;
                const double t = std::clamp(glm::dot(p - a, side) / glm::dot(side, side), 0.0, 1.0);
                least = std::min(least, glm::length(a + side * t - p));
            }
            return least;
        };
        const auto truth = [&](dvec3 p) {
            const double inside = (prism.holds(p) ? 1 : -1) * from_outline(dvec2(p)) + by;
            return std::abs(inside) < 1.5 * tolerance ? -1 : inside > 0 ? 1 : 0;
        };
        judge(*moved, z, lines(round % 2 == 0 ? Axis::x : Axis::y, 0.25, 0.25), truth, counts);
    }
    CHECK(counts.judged > 100'000);
    CHECK(counts.solid > 20'000);
    CHECK(counts.wrong == 0);
}

}  // namespace lattice_aligned_test
