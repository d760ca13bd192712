// Windows at seeds on a surface: spacing, closed forms on plane faces, brute force over seeds, thin walls.
#include "procedural/skin/surface_windows.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "tests/engine/field/gradings.h"
#include "tests/engine/solids/shapes.h"

namespace surface_windows_test {

using namespace lamella;

namespace {

SurfaceWindowSettings settings_of(double window, Graded strut, double corner, double depth) {
    SurfaceWindowSettings settings;
    settings.window = window;
    settings.strut = std::move(strut);
    settings.corner = corner;
    settings.depth = depth;
    return settings;
}

/// Seeds on the face z = top of a box, at least `margin` from its edges.
std::vector<dvec3> on_face(const std::vector<SurfaceFoot>& seeds, double top, double half, double margin) {
    std::vector<dvec3> found;
    for (const SurfaceFoot& seed : seeds) {
        const dvec3 p = seed.place;
        if (std::abs(p.z - top) < 1e-3 && std::max(std::abs(p.x), std::abs(p.y)) < half - margin)
            found.push_back(p);
    }
    return found;
}

/// The least distance of p from the faces of its cell, by the distances to all seeds.
double distance_to_faces(const std::vector<SurfaceFoot>& seeds, dvec3 p, std::size_t& own) {
    own = 0;
    for (std::size_t i = 1; i < seeds.size(); ++i) {
        if (length(seeds[i].place - p) < length(seeds[own].place - p)) own = i;
    }
    double least = infinity;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (i == own) continue;
        const dvec3 a = seeds[own].place, b = seeds[i].place;
        const double d = (glm::dot(p - b, p - b) - glm::dot(p - a, p - a)) / (2 * length(b - a));
        least = std::min(least, d);
    }
    return least;
}

/// Points of the outer part of a ball.
std::vector<dvec3> points_in_shell(double radius, double thickness, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1), depth(0, thickness);
    std::vector<dvec3> points;
    while (points.size() < static_cast<std::size_t>(count)) {
        const dvec3 way(unit(random), unit(random), unit(random));
        if (length(way) < 0.1 || length(way) > 1) continue;
        points.push_back(way / length(way) * (radius - depth(random)));
    }
    return points;
}

}  // namespace

TEST_CASE("scattered seeds keep their distance, leave no hole and are one to a pitch squared") {
    const double pitch = 1.5, radius = 20;
    const auto seeds = scatter_on_surface(*make_sphere(dvec3(1, 2, 3), radius), pitch, 5);
    double nearest = infinity;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        REQUIRE(length(seeds[i].place - dvec3(1, 2, 3)) == Approx(radius).margin(2e-3));
        for (std::size_t j = 0; j < i; ++j)
            nearest = std::min(nearest, length(seeds[i].place - seeds[j].place));
    }
    CHECK(nearest >= 0.8 * pitch);
    const double wanted = 4 * 3.14159265358979 * radius * radius / (pitch * pitch);
    CHECK(static_cast<double>(seeds.size()) == Approx(wanted).epsilon(0.03));
    for (const dvec3 p : points_in_shell(radius, 1e-9, 2000, 3)) {
        double least = infinity;
        for (const SurfaceFoot& seed : seeds)
            least = std::min(least, length(seed.place - p - dvec3(1, 2, 3)));
        REQUIRE(least < 1.1 * pitch);
    }
}

TEST_CASE("seeds are the same each time, and others with another number") {
    const FieldPtr ball = make_sphere(dvec3(0), 6);
    const auto same = [](const std::vector<SurfaceFoot>& a, const std::vector<SurfaceFoot>& b) {
        return a.size() == b.size() &&
               std::equal(a.begin(), a.end(), b.begin(),
                          [](const auto& s, const auto& t) { return s.place == t.place; });
    };
    CHECK(same(scatter_on_surface(*ball, 1.5, 5), scatter_on_surface(*ball, 1.5, 5)));
    CHECK_FALSE(same(scatter_on_surface(*ball, 1.5, 5), scatter_on_surface(*ball, 1.5, 6)));
    CHECK(same(hexagons_on_surface(*ball, 1.5), hexagons_on_surface(*ball, 1.5)));
}

TEST_CASE("on every flat face the lattice is one, each seed a pitch from its six neighbours") {
    const double pitch = 2, half = 20;
    const auto seeds = hexagons_on_surface(*make_box({dvec3(-half), dvec3(half)}), pitch);
    for (const double top : {half, -half}) {
        const auto inner = on_face(seeds, top, half, 2.5 * pitch);
        // Seeds stand as densely as a triangular lattice: one to sqrt(3)/2 pitch^2.
        const double side = 2 * (half - 2.5 * pitch);
        CHECK(static_cast<double>(inner.size()) ==
              Approx(side * side / (0.8660254 * pitch * pitch)).epsilon(0.04));
        for (const dvec3 p : inner) {
            std::vector<double> ways;
            for (const SurfaceFoot& seed : seeds) ways.push_back(length(seed.place - p));
            std::sort(ways.begin(), ways.end());
            for (std::size_t k = 1; k <= 6; ++k) REQUIRE(ways[k] == Approx(pitch).epsilon(1e-4));
            REQUIRE(ways[7] == Approx(std::sqrt(3) * pitch).epsilon(1e-4));
        }
    }
}

TEST_CASE("hexagonal windows take the share of a flat face that their width says") {
    const double window = 3, strut = 0.8, half = 15;
    const FieldPtr box = make_box({dvec3(-half), dvec3(half)});
    const auto seeds = hexagons_on_surface(*box, window + strut);
    const auto inner = on_face(seeds, half, half, 2 * (window + strut));
    REQUIRE(!inner.empty());
    const dvec3 p = inner.front();
    std::vector<dvec3> ways;
    for (const SurfaceFoot& seed : seeds) {
        const dvec3 way = seed.place - p;
        if (length(way) > 0.1 && length(way) < 1.2 * (window + strut)) ways.push_back(way);
    }
    REQUIRE(ways.size() == 6);
    const dvec3 a = ways[0];
    const dvec3 b = *std::find_if(ways.begin(), ways.end(), [&](dvec3 w) {
        return std::abs(glm::dot(w, a) - 0.5 * glm::dot(a, a)) < 0.01;
    });
    const SurfaceWindows windows(seeds, settings_of(window, strut, 0, 1));
    constexpr int n = 400;
    int open = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const dvec3 q = p + a * ((i + 0.5) / n) + b * ((j + 0.5) / n) - dvec3(0, 0, 0.5);
            if (windows.value(q) > 0) ++open;
        }
    }
    const double share = window / (window + strut);
    CHECK(static_cast<double>(open) / (n * n) == Approx(share * share).epsilon(2e-3));
}

TEST_CASE("a strut is as wide as stated across the face between two seeds") {
    const FieldPtr ball = make_sphere(dvec3(0), 9);
    const auto seeds = scatter_on_surface(*ball, 2.5, 1);
    const double strut = 0.6;
    const SurfaceWindows windows(seeds, settings_of(1.9, strut, 0.2, 1));
    int measured = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const dvec3 a = seeds[i].place, b = seeds[j].place, middle = (a + b) * 0.5;
            // Pairs whose face is hit halfway, far from its ends.
            std::size_t own = 0;
            bool plain = true;
            for (const dvec3 q : {middle + (a - b) * 1e-6, middle - (a - b) * 1e-6})
                plain = plain && std::abs(distance_to_faces(seeds, q, own)) < 1e-3 && (own == i || own == j);
            double third = infinity;
            for (std::size_t k = 0; k < seeds.size(); ++k) {
                if (k != i && k != j) third = std::min(third, length(seeds[k].place - middle));
            }
            if (!plain || third < length(a - middle) + 2 * strut) continue;
            ++measured;
            const dvec3 across = (a - b) / length(a - b);
            for (const double side : {-1.0, 1.0}) {
                CHECK(windows.value(middle + across * (side * (strut / 2 - 1e-6))) < 0);
                CHECK(windows.value(middle + across * (side * (strut / 2 + 1e-6))) > 0);
            }
        }
    }
    CHECK(measured > 10);
}

TEST_CASE("square-cornered windows are what the distances to all seeds say") {
    const double radius = 7, strut = 0.5;
    const auto seeds = scatter_on_surface(*make_sphere(dvec3(0), radius), 2, 3);
    const SurfaceWindows windows(seeds, settings_of(1.5, strut, 0, 1));
    int open = 0;
    for (const dvec3 p : points_in_shell(radius, 1, 4000, 17)) {
        std::size_t own = 0;
        const double d = distance_to_faces(seeds, p, own) - strut / 2;
        if (std::abs(d) < 1e-9) continue;
        REQUIRE((windows.value(p) > 0) == (d > 0));
        open += d > 0;
    }
    CHECK(open > 1000);
}

TEST_CASE("rounded windows are what discs sweep that keep clear of the struts") {
    const double half = 8, strut = 0.6, corner = 0.5;
    const auto seeds = scatter_on_surface(*make_box({dvec3(-half), dvec3(half)}), 2.4, 2);
    const SurfaceWindows windows(seeds, settings_of(1.8, strut, corner, 0.5));
    std::mt19937 random(8);
    std::uniform_real_distribution<double> at(-4, 4);
    int rounded = 0;
    for (int round = 0; round < 300; ++round) {
        const dvec3 p(at(random), at(random), half);
        std::size_t own = 0;
        const double room = distance_to_faces(seeds, p, own) - strut / 2;
        // Does a disc of the corners' radius that holds p fit between the struts?
        double best = -infinity;
        constexpr int n = 60;
        for (int i = -n; i <= n; ++i) {
            for (int j = -n; j <= n; ++j) {
                const dvec3 q = p + dvec3(i, j, 0) * (corner / n);
                if (length(q - p) > corner) continue;
                std::size_t other = 0;
                const double d = distance_to_faces(seeds, q, other) - strut / 2 - corner;
                if (other == own) best = std::max(best, d);
            }
        }
        if (std::abs(best) < 0.015 || std::abs(room) < 0.015) continue;
        INFO("at " << p.x << " " << p.y << ", best " << best << ", room " << room);
        REQUIRE((windows.value(p) > 0) == (best > 0));
        rounded += room > 0 && best < 0;
    }
    CHECK(rounded > 3);
}

TEST_CASE("a graded strut is half of each side's width") {
    const FieldPtr box = make_box({dvec3(-12), dvec3(12)});
    const auto seeds = hexagons_on_surface(*box, 3);
    const auto strut = std::make_shared<Linear>(0.8, dvec3(0.03, 0, 0));
    const SurfaceWindows windows(seeds, settings_of(2.2, GradingPtr(strut), 0, 1));
    int measured = 0;
    const auto inner = on_face(seeds, 12, 12, 5);
    for (const dvec3 a : inner) {
        for (const dvec3 b : inner) {
            if (a == b || length(a - b) > 3.1) continue;
            const dvec3 middle = (a + b) * 0.5, way = (a - b) / length(a - b);
            const double mine = strut->at(a) / 2;
            CHECK(windows.value(middle + way * (mine - 1e-6)) < 0);
            CHECK(windows.value(middle + way * (mine + 1e-6)) > 0);
            ++measured;
        }
    }
    CHECK(measured > 30);
}

TEST_CASE("no strut begins or ends nearer than the value says, also where struts vary and walls are thin") {
    const FieldPtr sheet = make_box({{-6, -6, -0.6}, {6, 6, 0.6}});
    const FieldPtr ball = make_sphere(dvec3(0), 6);
    const auto strut = std::make_shared<Linear>(0.5, dvec3(0.03, 0.02, 0));
    const SurfaceWindows patterns[] = {
        {scatter_on_surface(*sheet, 1.6, 4), settings_of(1.1, GradingPtr(strut), 0.2, 0.6)},
        {scatter_on_surface(*sheet, 1.6, 4), settings_of(0.4, 1.3, 0.2, 0.6)},
        {scatter_on_surface(*ball, 1.6, 4), settings_of(1.1, GradingPtr(strut), 0.2, 0.6)},
        {scatter_on_surface(*ball, 1.6, 4), settings_of(0.4, 1.3, 0.2, 0.6)}};
    CHECK(patterns[1].closed_count() > 0);
    CHECK(patterns[1].closed_count() < patterns[1].seed_count());
    std::mt19937 random(12);
    std::uniform_real_distribution<double> at(-6, 6), high(-0.6, 0.6), step(-0.5, 0.5);
    int open = 0;
    for (const SurfaceWindows& windows : patterns) {
        int far = 0;
        for (int round = 0; round < 60000; ++round) {
            const dvec3 p(at(random), at(random), &windows < patterns + 2 ? high(random) : at(random));
            const dvec3 q = p + dvec3(step(random), step(random), step(random));
            const double v = windows.value(p), w = windows.value(q);
            if (length(p - q) * (1 + 1e-9) >= std::abs(v) || w == 0) continue;
            ++far;
            open += v > 0;
            REQUIRE((v < 0) == (w < 0));
        }
        CHECK(far > 400);
    }
    CHECK(open > 300);
}

TEST_CASE("windows go through thin walls whose two sides have seeds of their own") {
    const FieldPtr sheet = make_box({{-10, -10, -0.5}, {10, 10, 0.5}});
    const auto seeds = scatter_on_surface(*sheet, 2.5, 4);
    const SurfaceWindows windows(seeds, settings_of(2, 0.5, 0.2, 0.5));
    int sides = 0;
    for (const SurfaceFoot& seed : seeds) {
        if (std::abs(seed.normal.z) < 0.99 || std::max(std::abs(seed.place.x), std::abs(seed.place.y)) > 7)
            continue;
        ++sides;
        CHECK(windows.value(seed.place - seed.normal * 0.25) > 0);
    }
    CHECK(sides > 20);
}

TEST_CASE("a skin of a mesh gets the windows of the ball that it approximates") {
    const FieldPtr mesh = make_mesh_field(shapes::closed(shapes::icosphere(4, 10)));
    const double pitch = 3;
    const auto seeds = scatter_on_surface(*mesh, pitch, 1);
    const double wanted = 4 * 3.14159265358979 * 100 / (pitch * pitch);
    CHECK(static_cast<double>(seeds.size()) == Approx(wanted).epsilon(0.08));
}

TEST_CASE("windows that cannot be are refused") {
    const FieldPtr ball = make_sphere(dvec3(0), 5);
    const auto refused = [&](double window, double strut, double corner, const char* word) {
        CHECK_THROWS_WITH(make_voronoi_windows(*ball, settings_of(window, strut, corner, 1), 1),
                          Catch::Contains(word));
    };
    refused(0, 0.5, 0.1, "window");
    refused(1, 0, 0.1, "strut");
    refused(1, 0.5, -1, "corner");
    CHECK_THROWS_AS(make_hexagon_windows(*make_half_space({0, 0, 1}, 0), settings_of(1, 0.5, 0.1, 1)),
                    InputError);
    CHECK_THROWS_WITH(make_voronoi_windows(*make_sphere(dvec3(0), 5000), settings_of(0.02, 0.01, 0, 1), 1),
                      Catch::Contains("larger ones"));
    CHECK_THROWS_AS(make_patterned_shell(make_shell(ball, 1), nullptr), InputError);
}

TEST_CASE("windows along a line are where points of it lie in windows", "[windows]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-6.5, 6.5);
    const FieldPtr ball = make_sphere(dvec3(0), 6), thin = make_box({{-6, -6, -0.6}, {6, 6, 0.6}});
    for (const auto& [body, depth] : {std::pair(ball, 1.5), std::pair(thin, 1.0)}) {
        for (const double corner : {0.0, 0.3, 2.0}) {
            const auto pattern = make_voronoi_windows(*body, settings_of(1.5, 0.5, corner, depth), 3);
            const auto hexagons = make_hexagon_windows(*body, settings_of(2, 0.4, corner, depth));
            int open = 0, wrong = 0;
            for (const SurfaceWindows* const windows : {pattern.get(), hexagons.get()}) {
                for (int i = 0; i < 400; ++i) {
                    const int axis = i % 3;
                    const dvec3 through(place(random), place(random), place(random));
                    std::vector<Interval> found;
                    std::uint32_t hint = 0;
                    REQUIRE(windows->windows_on(through, axis, {-7, 7}, hint, found));
                    CHECK(std::ranges::is_sorted(found, {}, [](const Interval& part) { return part.lo; }));
                    for (int k = 0; k < 300; ++k) {
                        dvec3 p = through;
                        p[axis] = place(random);
                        // Windows reach through the skin, seeds no farther.
                        if (std::abs(body->value(p)) > depth) continue;
                        const double value = windows->value(p);
                        const bool inside = std::ranges::any_of(
                            found, [&](const Interval& part) { return part.contains(p[axis]); });
                        if (std::abs(value) > 1e-6 && inside != (value > 0)) ++wrong;
                        open += inside ? 1 : 0;
                    }
                }
            }
            INFO("corner " << corner << ", depth " << depth);
            CHECK(open > 1000);
            CHECK(wrong == 0);
        }
    }
}

}  // namespace surface_windows_test
