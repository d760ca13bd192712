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
    // The mean height of that face over the bed is half of its rise.
    CHECK(leans.support_volume == Approx(200.0 / 9 * 2 * (20 * std::sin(pi / 6)) / 2).epsilon(0.05));
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
    CHECK(figures.support_volume == Approx(18 * 20 / 4.0 * 10).epsilon(0.06));
}

TEST_CASE("a mushroom is printed upside down", "[orientation]") {
    const SurfaceCover cover = cover_surface(*mushroom(), sites, nullptr);
    const OrientationRules rules{.spacing = 2, .pillar_area = 1, .layer_height = 0.2};
    const OrientationFigures upright = orientation_figures(cover, {0, 0, 1}, rules);
    CHECK(upright.overhang_area == Approx(pi * (64 - 4)).epsilon(0.05));
    CHECK(upright.support_volume == Approx(pi * (64 - 4) / 4 * 10).epsilon(0.06));
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
