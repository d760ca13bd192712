// The grid's surface, normals and cut faces lie where closed forms say.
#include "recipe/output/coverage_grid.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/solids/primitives.h"
#include "recipe/output/cut_face.h"

namespace coverage_grid_test {

using namespace lamella;

namespace {

/// Directions spread evenly over the sphere.
dvec3 direction(int i, int count) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), a = i * 2.399963229728653;
    return {r * std::cos(a), r * std::sin(a), z};
}

}  // namespace

TEST_CASE("rays meet a ball at its radius, where normals point outward", "[preview]") {
    const dvec3 centre(0.3, -0.2, 0.1);
    const FieldPtr ball = make_sphere(centre, 10);
    const CoverageGrid grid({ball, nullptr}, ball->bounds(), 100, 1e8, nullptr);
    constexpr int count = 2000;
    double squares = 0, greatest = 0, steepest = 0, sum = 0;
    for (int i = 0; i < count; ++i) {
        const dvec3 out = direction(i, count);
        const BrickMap::Ray ray(grid.to_grid(centre + out * 20.0), -out);
        const auto t = grid.surface(ray, 0, 1000);
        REQUIRE(t.has_value());
        const double off = length(grid.to_part(ray.at(*t)) - centre) - 10;
        squares += off * off;
        greatest = std::max(greatest, std::abs(off));
        const dvec3 slope = -grid.densities().slope(ray.at(*t));
        const double angle = std::acos(std::min(1.0, dot(slope, out) / length(slope))) * 180 / pi;
        steepest = std::max(steepest, angle);
        sum += angle;
    }
    CHECK(std::sqrt(squares / count) < 0.08 * grid.pitch());
    CHECK(greatest < 0.35 * grid.pitch());
    CHECK(sum / count < 2);
    CHECK(steepest < 9);
}

TEST_CASE("rays beside a ball meet nothing", "[preview]") {
    const FieldPtr ball = make_sphere(dvec3(0), 10);
    const CoverageGrid grid({ball, nullptr}, ball->bounds(), 100, 1e8, nullptr);
    for (int i = 0; i < 500; ++i) {
        const dvec3 out = direction(i, 500);
        const dvec3 along = glm::normalize(glm::cross(out, dvec3(0.3, 0.5, 0.8)));
        const auto hits = [&](double radius) {
            const BrickMap::Ray ray(grid.to_grid(out * radius - along * 30.0), along);
            return grid.surface(ray, 0, 1000).has_value();
        };
        REQUIRE_FALSE(hits(10 + 0.6 * grid.pitch()));
        REQUIRE(hits(10 - 0.6 * grid.pitch()));
    }
}

TEST_CASE("a slanted plane has its normal everywhere", "[preview]") {
    // Nearly level planes are the hardest: their borders move far from slice to slice.
    for (const double degrees : {4.0, 10.0, 30.0, 60.0, 85.0}) {
        const double a = degrees * pi / 180;
        const dvec3 up(std::sin(a) * 0.8, std::sin(a) * 0.6, std::cos(a));
        const FieldPtr half = make_half_space(up, 0);
        const CoverageGrid grid({half, nullptr}, {dvec3(-10), dvec3(10)}, 100, 1e8, nullptr);
        double steepest = 0;
        for (int i = 0; i < 400; ++i) {
            const dvec3 place(-6 + 12.0 * (i % 20) / 19, -6 + 12.0 * (i / 20) / 19, 0);
            const dvec3 start = place - up * dot(place, up) + up * 3.0;
            const BrickMap::Ray ray(grid.to_grid(start), -up);
            const auto t = grid.surface(ray, 0, 1000);
            REQUIRE(t.has_value());
            REQUIRE(std::abs(dot(grid.to_part(ray.at(*t)), up)) < 0.3 * grid.pitch());
            const dvec3 slope = -grid.densities().slope(ray.at(*t));
            steepest =
                std::max(steepest, std::acos(std::min(1.0, dot(slope, up) / length(slope))) * 180 / pi);
        }
        INFO(degrees << " degrees from level");
        CHECK(steepest < 4);
    }
}

TEST_CASE("the face of a cut has the area of the section", "[preview]") {
    const FieldPtr ball = make_sphere(dvec3(0), 10);
    const FieldPtr box = make_box({{-10, -10, -10}, {10, 10, -4}});
    constexpr double at = 3;
    for (int axis = 0; axis < 3; ++axis) {
        const CutFace face({ball, box}, {dvec3(-10), dvec3(10)}, {axis, at, 1}, 0.2, nullptr);
        constexpr int samples = 400;
        int part = 0, second = 0;
        for (int j = 0; j < samples; ++j) {
            for (int i = 0; i < samples; ++i) {
                dvec3 p(0);
                p[axis] = at;
                p[(axis + 1) % 3] = -10 + 20 * (i + 0.5) / samples;
                p[(axis + 2) % 3] = -10 + 20 * (j + 0.5) / samples;
                const CutFace::Kind kind = face.at(p);
                part += kind == CutFace::Kind::part ? 1 : 0;
                second += kind == CutFace::Kind::second ? 1 : 0;
            }
        }
        const double sample = 20.0 * 20 / (samples * samples), disc = pi * (100 - at * at);
        CHECK(part * sample == Approx(disc).epsilon(0.003));
        // The box's section outside the disc: below z = -4, or nothing at z = 3.
        const double r = std::sqrt(100 - at * at), half = std::acos(4 / r);
        const double below = r * r * half - 4 * std::sqrt(r * r - 16);
        CHECK(second * sample == Approx(axis == 2 ? 0 : 20 * 6 - below).epsilon(0.006));
    }
}

}  // namespace coverage_grid_test
