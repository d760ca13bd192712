// Figures of orientations against closed forms, and the best orientation of shapes that have an obvious one.
#include "procedural/orientation/best_orientations.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace orientation_test {

using namespace lamella;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t sites = 20000;

double total_area(const SurfaceCover& cover) {
    double total = 0;
    for (const double area : cover.areas) total += area;
    return total;
}

/// A cap of 16 mm on a stem of 4 mm and 10 mm height.
FieldPtr mushroom() {
    return make_union({make_cylinder({0, 0, 0}, {0, 0, 10}, 2), make_cylinder({0, 0, 10}, {0, 0, 12}, 8)});
}

}  // namespace

TEST_CASE("the points of a surface stand for its area", "[orientation]") {
    CHECK(total_area(cover_surface(*make_sphere({1, 2, 3}, 10), sites, nullptr)) ==
          Approx(4 * pi * 100).epsilon(0.01));
    CHECK(total_area(cover_surface(*make_box({dvec3(0), dvec3(10, 20, 30)}), sites, nullptr)) ==
          Approx(2200).epsilon(0.04));  // an edge takes half a spacing from the faces beside it
    CHECK(total_area(cover_surface(*make_cylinder({0, 0, 0}, {3, 5, 9}, 4), sites, nullptr)) ==
          Approx(2 * pi * 4 * (std::sqrt(115.0) + 4)).epsilon(0.02));
}

TEST_CASE("a box stands, lies and leans", "[orientation]") {
    const SurfaceCover cover = cover_surface(*make_box({dvec3(0), dvec3(10, 20, 30)}), sites, nullptr);
    const OrientationRules rules{.overhang = 1, .spacing = 3, .pillar_area = 2, .layer_height = 0.2};
    const OrientationFigures stands = orientation_figures(cover, {0, 0, 1}, rules);
    CHECK(stands.height == Approx(30).margin(0.01));
    CHECK(stands.bed_area == Approx(200).epsilon(0.1));
    CHECK(stands.largest_layer == Approx(200).epsilon(0.1));
    CHECK(stands.overhang_area == 0);
    CHECK(stands.support_volume < 0.01);
    CHECK(orientation_figures(cover, {-1, 0, 0}, rules).largest_layer == Approx(600).epsilon(0.03));
    // It leans by 30 degrees about x: the face of 10 x 30 mm faces down less steeply than 45 degrees, that of
    // 10 x 20 mm more so.
    const dvec3 leaning(0, std::sin(pi / 6), std::cos(pi / 6));
    const OrientationFigures leans = orientation_figures(cover, leaning, rules);
    CHECK(leans.overhang_area == Approx(200).epsilon(0.04));
    CHECK(leans.height == Approx(20 * std::sin(pi / 6) + 30 * std::cos(pi / 6)).epsilon(0.01));
    CHECK(leans.support_volume < 38 * 2 * 20 * std::sin(pi / 6));
    // Supports are at least 3 mm from each other and leave no site farther from all: their number is between
    // those of the thinnest cover and of the densest packing.
    OrientationRules tips = rules;
    tips.connector = 1e-3;
    tips.tip_area = 1e3;
    tips.pillar_area = 0;
    const double number = orientation_figures(cover, leaning, tips).support_volume;
    CHECK(number > 0.385 * 200 / 9);
    CHECK(number < 1.155 * 13 * 23 / 9);
}

TEST_CASE("a pillar goes down to the surface below it", "[orientation]") {
    // A plate of 2 mm, 10 mm above one of 4 mm, held by a wall at one side.
    const FieldPtr shelf =
        make_union({make_box({dvec3(0), dvec3(20, 20, 4)}), make_box({dvec3(0, 0, 14), dvec3(20, 20, 16)}),
                    make_box({dvec3(0), dvec3(2, 20, 16)})});
    const SurfaceCover cover = cover_surface(*shelf, sites, nullptr);
    const OrientationFigures figures = orientation_figures(
        cover, {0, 0, 1}, {.spacing = 2, .pillar_area = 1, .foot_volume = 100, .layer_height = 0.2});
    CHECK(figures.overhang_area == Approx(18 * 20).epsilon(0.04));
    // Whole pillars of 10 mm.
    CHECK(std::fmod(figures.support_volume + 1, 10) == Approx(1).margin(0.5));
    CHECK(figures.support_volume > 0.385 * 18 * 20 / 4 * 10);
    CHECK(figures.support_volume < 1.155 * 19 * 21 / 4 * 10);
}

TEST_CASE("a ridge that faces down is held at every spacing", "[orientation]") {
    // Two faces of a box meet in an edge of 30 mm that rises by 10 degrees: each holds itself, the edge does
    // not.
    const SurfaceCover cover = cover_surface(*make_box({dvec3(0), dvec3(10, 10, 30)}), sites, nullptr);
    const OrientationRules rules{.overhang = 1.2, .spacing = 3, .pillar_area = 1, .layer_height = 0.2};
    const double rise = 10 * pi / 180, side = std::cos(rise) / std::sqrt(2.0);
    const OrientationFigures figures = orientation_figures(cover, {side, side, std::sin(rise)}, rules);
    const double mean_height = 30 * std::sin(rise) / 2;
    CHECK(figures.support_volume > 30.0 / 6 * mean_height);
    CHECK(figures.support_volume < 2 * 30.0 / 3 * mean_height);
}

TEST_CASE("a part stands as far as its centroid is inside what touches the bed", "[orientation]") {
    const OrientationRules rules{.layer_height = 0.2};
    const SurfaceCover box = cover_surface(*make_box({dvec3(100, 0, 0), dvec3(110, 20, 30)}), sites, nullptr);
    CHECK(length(box.centroid - dvec3(105, 10, 15)) < 0.05);
    CHECK(orientation_figures(box, {0, 0, 1}, rules).stands == Approx(5).margin(0.6));
    CHECK(orientation_figures(box, {-1, 0, 0}, rules).stands == Approx(10).margin(0.6));
    // On an edge, leaning by 30 degrees: the centroid is beside it.
    const double beside = std::hypot(10, 15) * std::sin(pi / 6 - std::atan2(10, 15));
    CHECK(orientation_figures(box, {0, std::sin(pi / 6), std::cos(pi / 6)}, rules).stands ==
          Approx(-std::abs(beside)).margin(0.3));
    // A boom of 40 x 4 x 4 mm on a post of 4 x 4 x 10 mm: its centroid is beyond the post.
    const FieldPtr crane =
        make_union({make_box({dvec3(0), dvec3(4, 4, 10)}), make_box({dvec3(0, 0, 10), dvec3(40, 4, 14)})});
    const double centroid = (160.0 * 2 + 640.0 * 20) / 800;
    CHECK(orientation_figures(cover_surface(*crane, sites, nullptr), {0, 0, 1}, rules).stands ==
          Approx(4 - centroid).margin(0.2));
}

TEST_CASE("the largest step is between two layers, not the bed or the top", "[orientation]") {
    const OrientationRules rules{.layer_height = 0.2};
    const auto step = [&](const FieldPtr& body) {
        return orientation_figures(cover_surface(*body, sites, nullptr), {0, 0, 1}, rules).largest_step;
    };
    CHECK(step(make_box({dvec3(0), dvec3(10, 20, 30)})) < 4);
    CHECK(step(mushroom()) == Approx(pi * (64 - 4)).epsilon(0.05));
    // Between layers of 0.2 mm near its poles, a ball's sections differ by 2 pi r h, less their curvature.
    CHECK(step(make_sphere(dvec3(0), 10)) == Approx(2 * pi * 10 * 0.2).epsilon(0.3));
}

TEST_CASE("loads act across layers by the share along the direction", "[orientation]") {
    const SurfaceCover cover = cover_surface(*mushroom(), 3000, nullptr);
    OrientationRules rules;
    CHECK(orientation_figures(cover, {0, 0, 1}, rules).load_across == 0);
    rules.loads = {{0, 0, -5}};
    CHECK(orientation_figures(cover, {0, 0, 1}, rules).load_across == Approx(1));
    CHECK(orientation_figures(cover, {0, 1, 0}, rules).load_across == Approx(0));
    rules.loads = {{0, 0, 3}, {0, 1, 0}};
    const double half = std::sqrt(0.5);
    CHECK(orientation_figures(cover, {0, half, half}, rules).load_across == Approx(half));
    CHECK(orientation_figures(cover, {0, 1, 0}, rules).load_across == Approx(0.25));
}

TEST_CASE("a mushroom is printed upside down", "[orientation]") {
    const SurfaceCover cover = cover_surface(*mushroom(), sites, nullptr);
    const OrientationRules rules{.spacing = 2, .pillar_area = 1, .layer_height = 0.2};
    const OrientationFigures upright = orientation_figures(cover, {0, 0, 1}, rules);
    CHECK(upright.overhang_area == Approx(pi * (64 - 4)).epsilon(0.05));
    CHECK(upright.support_volume > 0.385 * pi * (64 - 4) / 4 * 10);
    CHECK(upright.support_volume < 1.155 * pi * (81 - 1) / 4 * 10);
    const auto by_supports = [](const OrientationFigures& f) { return f.support_volume; };
    const auto best = best_orientations(cover, rules, by_supports, 5, 10, nullptr);
    REQUIRE(best.size() == 5);
    CHECK(length(best.front().up - dvec3(0, 0, -1)) < 1e-6);
    CHECK(best.front().support_volume == 0);
    for (std::size_t i = 1; i < best.size(); ++i) {
        CHECK(best[i].support_volume >= best[i - 1].support_volume);
        for (std::size_t k = 0; k < i; ++k) CHECK(dot(best[i].up, best[k].up) < std::cos(9.9 * pi / 180));
    }
    const auto by_height = [](const OrientationFigures& f) { return f.height; };
    CHECK(best_orientations(cover, rules, by_height, 1, 10, nullptr).front().height < 12.1);
}

TEST_CASE("orientations do not depend on threads", "[orientation]") {
    const SurfaceCover cover = cover_surface(*mushroom(), 3000, nullptr);
    const auto score = [](const OrientationFigures& f) { return f.overhang_area + f.height; };
    const auto found = [&](int threads) {
        ThreadArena arena(threads);
        std::vector<dvec3> ups;
        for (const OrientationFigures& figures :
             arena.execute([&] { return best_orientations(cover, {}, score, 8, 10, nullptr); }))
            ups.push_back(figures.up);
        return ups;
    };
    CHECK(found(1) == found(4));
}

}  // namespace orientation_test
