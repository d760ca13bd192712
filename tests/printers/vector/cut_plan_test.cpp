// A layer's cuts have the right sizes, run in the right order, and marks lie on its material.
#include "printers/vector/cut_plan.h"

#include <catch2/catch.hpp>

#include "printers/vector/stroke_digits.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/vector/cut_raster.h"

namespace cut_plan_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr double tolerance = 0.01;

double ring_area(const SheetPath& path) {
    double twice = 0;
    for (std::size_t i = 0; i < path.points.size(); ++i) {
        const dvec2 a = path.points[i], b = path.points[(i + 1) % path.points.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2;
}

std::vector<SheetPath> of(const CutPlan& plan, CutPurpose purpose) {
    std::vector<SheetPath> paths;
    for (const SheetPath& path : plan.paths) {
        if (path.purpose == purpose) paths.push_back(path);
    }
    return paths;
}

std::vector<Ring> cut_rings(const CutPlan& plan) {
    std::vector<Ring> rings;
    for (const SheetPath& path : plan.paths) {
        if (path.purpose >= CutPurpose::inner) rings.push_back(path.points);
    }
    return rings;
}

double distance_to(const std::vector<Ring>& rings, dvec2 p) {
    double least = infinity;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const dvec2 a = ring[i], way = ring[(i + 1) % ring.size()] - a;
            const double t = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
            least = std::min(least, glm::length(p - a - way * t));
        }
    }
    return least;
}

CutPlan plan(const Job& job, int index, const CuttingProfile& profile) {
    return plan_cuts(job, Layer(job, index), profile, tolerance);
}

/// A prism over figures less holes, two layers of 1 mm.
Job prism(std::vector<Figure> figures, std::vector<Figure> holes = {}) {
    return make_job(
        {{-50, -50, 0}, {50, 50, 2}}, [=](double) { return figures; }, 1, [=](double) { return holes; });
}

}  // namespace

TEST_CASE("a kerf makes the disc larger and the hole in it smaller", "[cut]") {
    const Job job = prism({disc({1, 2}, 20)}, {disc({1, 2}, 8)});
    CuttingProfile profile;
    const double kerf = GENERATE(0.0, 0.1, 0.25, 1.0);
    CAPTURE(kerf);
    profile.kerf = kerf;
    const CutPlan found = plan(job, 0, profile);
    REQUIRE(found.paths.size() == 2);
    CHECK(found.paths[0].purpose == CutPurpose::inner);
    CHECK(found.paths[1].purpose == CutPurpose::outer);
    const double outer = 20 + kerf / 2, inner = 8 - kerf / 2;
    CHECK(ring_area(found.paths[1]) == Approx(pi * outer * outer).epsilon(5e-4));
    CHECK(ring_area(found.paths[0]) == Approx(-pi * inner * inner).epsilon(1e-3));
    for (const dvec2& p : found.paths[1].points)
        CHECK(glm::length(p - dvec2(1, 2)) == Approx(outer).margin(tolerance + 0.005));
    CHECK(found.area == Approx(pi * (400 - 64)).epsilon(5e-4));  // that of the part, not of the cut
    CHECK(found.closed_holes == 0);
    CHECK(found.merged_pieces == 0);
    CHECK(found.extent.hi.x == Approx(1 + outer).margin(0.02));
}

TEST_CASE("holes and gaps that a kerf closes are counted", "[cut]") {
    const Job job = prism({rectangle({-20, -10}, {-0.2, 10}), rectangle({0.2, -10}, {20, 10})},
                          {disc({-10, 0}, 0.3), disc({10, 0}, 3)});
    CuttingProfile profile;
    profile.kerf = 0.3;
    CutPlan found = plan(job, 0, profile);
    CHECK(found.pieces == 2);
    CHECK(found.closed_holes == 0);
    CHECK(found.merged_pieces == 0);
    profile.kerf = 0.7;
    found = plan(job, 0, profile);
    CHECK(found.closed_holes == 1);
    CHECK(found.merged_pieces == 1);
    CHECK(found.paths.size() == 2);
}

TEST_CASE("cuts run from the inside out, the outline that frees a piece last", "[cut]") {
    // Rings within rings, and a loose disc in the middle.
    const Job job = make_job(
        {{-50, -50, 0}, {50, 50, 1}},
        [](double) {
            return std::vector<Figure>{disc({0, 0}, 40)};
        },
        1,
        [](double) {
            return std::vector<Figure>{rectangle({-20, -20}, {20, 20}), rectangle({25, -3}, {30, 3})};
        });
    Job nested = job;
    struct Sum : Field {
        FieldPtr a, b;
        double value(dvec3 p) const override { return std::min(a->value(p), b->value(p)); }
        Box bounds() const override { return a->bounds(); }
    };
    const auto sum = std::make_shared<Sum>();
    sum->a = job.part;
    sum->b = make_job(
                 {{-50, -50, 0}, {50, 50, 1}},
                 [](double) {
                     return std::vector<Figure>{disc({0, 0}, 15)};
                 },
                 1,
                 [](double) {
                     return std::vector<Figure>{disc({0, 0}, 5)};
                 })
                 .part;
    nested.part = sum;
    const CutPlan found = plan(nested, 0, {});
    REQUIRE(found.paths.size() == 5);
    CHECK(found.pieces == 2);
    const std::vector<double> areas{-pi * 25, pi * 225, -1600, -30, pi * 1600};
    CHECK(ring_area(found.paths[0]) == Approx(areas[0]).epsilon(0.01));
    CHECK(ring_area(found.paths[1]) == Approx(areas[1]).epsilon(0.01));
    CHECK(ring_area(found.paths[2]) + ring_area(found.paths[3]) == Approx(areas[2] + areas[3]).epsilon(0.01));
    CHECK(ring_area(found.paths[4]) == Approx(areas[4]).epsilon(0.01));
    for (int i = 0; i < 4; ++i) CHECK(found.paths[static_cast<std::size_t>(i)].purpose == CutPurpose::inner);
    CHECK(found.paths[4].purpose == CutPurpose::outer);
}

TEST_CASE("tied pieces are cut as one", "[cut]") {
    const Job job = prism({disc({-20, 0}, 10), disc({12, 5}, 14), disc({0, -30}, 8)});
    CuttingProfile profile;
    CHECK(count_raster_pieces(cut_rings(plan(job, 0, profile)), 0.2) == 3);
    profile.ties = Ties::join;
    profile.kerf = 0.2;
    const CutPlan found = plan(job, 0, profile);
    CHECK(found.pieces == 3);
    CHECK(of(found, CutPurpose::outer).size() == 1);
    CHECK(count_raster_pieces(cut_rings(found), 0.2) == 1);
    CHECK(found.area == Approx(pi * (100 + 196 + 64)).epsilon(1e-3));
}

TEST_CASE("the number lies inside the solid, clear of every border", "[cut]") {
    // An L with a hole where its middle would be.
    const Job job =
        prism({rectangle({-30, -30}, {30, -12}), rectangle({-30, -30}, {-14, 30})}, {disc({-20, -20}, 4)});
    CuttingProfile profile;
    profile.numbers = true;
    profile.number_height = GENERATE(3.0, 8.0, 200.0);
    CAPTURE(profile.number_height);
    const CutPlan found = plan(job, 1, profile);
    CHECK(!found.unnumbered);
    const auto strokes = of(found, CutPurpose::engrave);
    REQUIRE(strokes.size() == number_strokes(1, {0, 0}, 1).size());
    CHECK(found.paths.front().purpose == CutPurpose::engrave);
    Rect box;
    for (const SheetPath& stroke : strokes) {
        CHECK(!stroke.closed);
        for (const dvec2& p : stroke.points) {
            box = unite(box, Rect{p, p});
            CHECK(inside_rings(cut_rings(found), p));
            CHECK(distance_to(cut_rings(found), p) > 0.45);
        }
    }
    CHECK(box.size().y <= profile.number_height + 1e-9);
    if (profile.number_height < 10) CHECK(box.size().y == Approx(profile.number_height));
    // The widest disc of this L has a diameter of 18 mm; the search comes near to what fits into it.
    if (profile.number_height > 10) CHECK(box.size().y > 0.85 * 17 / std::sqrt(1 + 0.36));
}

TEST_CASE("where there is no room for a number there is none", "[cut]") {
    const Job job = prism({rectangle({-30, -1}, {30, 1})});
    CuttingProfile profile;
    profile.numbers = true;
    const CutPlan found = plan(job, 0, profile);
    CHECK(found.unnumbered);
    CHECK(of(found, CutPurpose::engrave).empty());
}

TEST_CASE("the next layer's outline is scored where it lies on this one", "[cut]") {
    // A disc that moves right and shrinks: part of the next one's outline lies outside this one.
    const Job job = make_job(
        {{-50, -50, 0}, {50, 50, 3}},
        [](double z) {
            return std::vector<Figure>{z < 1 ? disc({0, 0}, 20) : z < 2 ? disc({6, 0}, 18) : disc({6, 0}, 5)};
        },
        1);
    CuttingProfile profile;
    profile.next_outline = true;
    const CutPlan first = plan(job, 0, profile);
    const auto scores = of(first, CutPurpose::score);
    REQUIRE(scores.size() == 1);  // one stretch, though the ring begins somewhere in it
    CHECK(!scores[0].closed);
    double length = 0;
    for (std::size_t i = 0; i < scores[0].points.size(); ++i) {
        const dvec2 p = scores[0].points[i];
        CHECK(glm::length(p - dvec2(6, 0)) == Approx(18).margin(tolerance));
        CHECK(glm::length(p) < 20 - 0.18);
        if (i > 0) length += glm::length(p - scores[0].points[i - 1]);
    }
    // Circles of radii 18 about (6, 0) and 19.8 about the origin cross where x = (36 + 19.8^2 - 18^2) / 12.
    const double x = (36 + 19.8 * 19.8 - 324) / 12;
    const double half_angle = std::acos((6 - x) / 18);
    CHECK(length == Approx(2 * half_angle * 18).epsilon(0.01));
    const auto whole = of(plan(job, 1, profile), CutPurpose::score);
    REQUIRE(whole.size() == 1);
    CHECK(whole[0].closed);
    CHECK(std::abs(ring_area(whole[0])) == Approx(pi * 25).epsilon(0.01));
    CHECK(of(plan(job, 2, profile), CutPurpose::score).empty());
}

TEST_CASE("upright walls score nothing: the cut is there already", "[cut]") {
    const Job job = prism({disc({0, 0}, 20)}, {rectangle({-3, -3}, {3, 3})});
    CuttingProfile profile;
    profile.next_outline = true;
    profile.kerf = 0.2;
    CHECK(of(plan(job, 0, profile), CutPurpose::score).empty());
}

TEST_CASE("an empty layer has nothing to cut", "[cut]") {
    const Job job = prism({});
    CuttingProfile profile;
    profile.numbers = profile.next_outline = true;
    profile.kerf = 1;
    const CutPlan found = plan(job, 0, profile);
    CHECK(found.paths.empty());
    CHECK(found.extent.empty());
    CHECK(!found.unnumbered);
    CHECK(found.pieces == 0);
}

}  // namespace cut_plan_test
