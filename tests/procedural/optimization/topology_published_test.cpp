// Whole optimisations against the values that public codes print: loop counts and compliances.
//
// top88: Andreassen et al. 2011; top99neo and top3D125: Ferrari and Sigmund 2020, "A new generation 99 line
// Matlab code for compliance topology optimization and its extension to 3D".
#include <catch2/catch.hpp>
#include <map>

#include "tests/procedural/optimization/topology_problems.h"

namespace topology_published_test {

using namespace lamella;

namespace {

/// What was found: compliance by loop (from 1), the number of loops, and the most iterations of a solve.
struct Course {
    std::map<int, TopologyIteration> loops;
    int count = 0;
    int most_iterations = 0;

    double compliance(int loop) const { return loops.at(loop).compliance; }
    double last() const { return compliance(count); }
};

template <std::size_t Dim>
Course follow(TopologyOptimizer<Dim>& optimizer) {
    Course course;
    while (!optimizer.is_finished()) {
        const TopologyIteration loop = optimizer.iterate();
        course.count = loop.index;
        course.most_iterations = std::max(course.most_iterations, loop.solver_iterations);
        course.loops[loop.index] = loop;
    }
    return course;
}

struct Published {
    int nx, ny;
    double volume, radius;
    bool sensitivity;
    double first, second, tenth;
    int loops;
    double last;
};

TopologySettings top88(double radius, bool sensitivity) {
    TopologySettings settings;
    settings.density.radius = radius;
    settings.sensitivity_filter = sensitivity;
    settings.iterations = 1000;
    settings.solver_tolerance = 1e-7;
    return settings;
}

void check_row(const Published& row, const TopologyProblem<2>& problem) {
    CAPTURE(row.nx, row.ny, row.volume, row.radius, row.sensitivity);
    TopologyOptimizer<2> optimizer(problem, top88(row.radius, row.sensitivity));
    const Course course = follow(optimizer);
    CHECK(course.compliance(1) == Approx(row.first).epsilon(1e-6));
    CHECK(course.compliance(2) == Approx(row.second).epsilon(1e-6));
    CHECK(course.compliance(10) == Approx(row.tenth).epsilon(1e-5));
    CHECK(course.count == row.loops);
    CHECK(course.last() == Approx(row.last).epsilon(1e-4));
    CHECK(course.loops.at(course.count).volume == Approx(row.volume).epsilon(1e-3));
}

void check_half_beam(const Published& row) { check_row(row, half_mbb_beam(row.nx, row.ny, row.volume)); }

}  // namespace

TEST_CASE("the 60x20 beam takes the course of top88", "[optimization]") {
    check_half_beam({60, 20, 0.5, 2.4, true, 1007.0221, 583.6279, 294.6178, 106, 216.8137});
    check_half_beam({60, 20, 0.5, 2.4, false, 1007.0221, 579.2263, 306.3467, 144, 233.7146});
    check_half_beam({60, 20, 0.5, 1.5, true, 1007.0221, 579.4187, 272.8888, 94, 203.1925});
}

TEST_CASE("the 150x50 beam takes the course of top88", "[optimization]") {
    check_half_beam({150, 50, 0.5, 6, true, 1033.0446, 592.2743, 297.8118, 95, 219.5199});
}

TEST_CASE("larger beams take the course of top88", "[optimization][slow]") {
    check_half_beam({120, 40, 0.5, 3, false, 1026.8431, 584.4997, 284.8170, 391, 219.2583});
    check_half_beam({150, 50, 0.5, 6, false, 1033.0446, 587.9334, 309.7348, 362, 235.7337});
    check_half_beam({180, 60, 0.4, 5.4, true, 2027.5046, 1116.2181, 427.8441, 99, 265.5866});
    check_half_beam({180, 60, 0.4, 5.4, false, 2027.5046, 1109.2744, 448.5166, 485, 289.0581});
}

TEST_CASE("the 300x100 beam takes the course of top88", "[optimization][slow]") {
    check_half_beam({300, 100, 0.5, 12, true, 1052.1190, 599.3527, 300.4386, 93, 222.2857});
}

TEST_CASE("the 120x40 cantilever takes the course of an independent program", "[optimization]") {
    const TopologyProblem<2> problem = plane_cantilever(120, 40, 0.5, 20);
    TopologyOptimizer<2> optimizer(problem, top88(3, false));
    const Course course = follow(optimizer);
    CHECK(course.compliance(1) == Approx(947.5945).epsilon(1e-6));
    CHECK(course.count == 227);
    CHECK(course.last() == Approx(198.6537).epsilon(1e-4));
}

/// Sigmund 2001, "A 99 line topology optimization code written in Matlab", section 4.3: two load cases.
/// Values of top88 with the changes printed there, which were run under Octave.
TEST_CASE("a cantilever of two load cases takes the course of top88", "[optimization]") {
    const auto check = [](const Published& row) {
        check_row(row, cantilever_of_two_cases(row.nx, row.ny, row.volume));
    };
    check({30, 30, 0.4, 1.2, true, 445.4932, 269.4926, 67.4647, 76, 61.2114});
    check({60, 40, 0.4, 2.4, false, 806.9895, 516.2974, 264.1285, 118, 149.1744});
    check({150, 150, 0.5, 6, true, 283.3983, 164.7430, 57.1179, 26, 56.2457});
}

TEST_CASE("the method of moving asymptotes ends at the published compliances", "[optimization]") {
    const TopologyProblem<2> problem = half_mbb_beam(60, 20, 0.5);
    TopologySettings settings = top88(2.4, false);
    settings.method = TopologyMethod::mma;
    TopologyOptimizer<2> dense(problem, settings);
    const Course density = follow(dense);
    CHECK(density.count == 58);
    CHECK(density.last() == Approx(233.4882).epsilon(1e-3));
    settings.sensitivity_filter = true;
    TopologyOptimizer<2> sensitive(problem, settings);
    const Course sensitivity = follow(sensitive);
    // Without a true gradient the last loops wander: 110 of them were published.
    CHECK(sensitivity.last() == Approx(216.17).epsilon(1e-3));
}

TEST_CASE("with mirrored borders the 60x20 beam takes the course of top99neo", "[optimization]") {
    const TopologyProblem<2> problem = half_mbb_beam(60, 20, 0.5);
    TopologySettings settings = top88(2.4, false);
    settings.density.padding = FilterPadding::mirror;
    settings.oc_tolerance = 1e-6;
    settings.iterations = 100;
    settings.tolerance = 0;
    TopologyOptimizer<2> optimizer(problem, settings);
    const Course course = follow(optimizer);
    const std::map<int, double> published{
        {1, 1007.0221}, {2, 578.8285}, {10, 305.8383}, {50, 235.7183}, {100, 232.8137}};
    for (const auto& [loop, compliance] : published) {
        CAPTURE(loop, course.compliance(loop) / compliance - 1);
        CHECK(course.compliance(loop) == Approx(compliance).epsilon(5e-4));
    }
}

TEST_CASE("a solid cantilever takes the course of top3D125", "[optimization]") {
    const TopologyProblem<3> problem = solid_cantilever(24, 12, 12, 0.12, 1e-9);
    TopologySettings settings;
    settings.density.radius = std::sqrt(3.0);
    settings.density.padding = FilterPadding::mirror;
    settings.iterations = 50;
    settings.tolerance = 0;
    settings.oc_tolerance = 1e-6;
    settings.solver_tolerance = 1e-7;
    TopologyOptimizer<3> optimizer(problem, settings);
    const Course course = follow(optimizer);
    const std::map<int, double> published{
        {1, 119669}, {2, 69641.0}, {3, 48779.5}, {10, 11609.3}, {50, 2824.07}};
    for (const auto& [loop, compliance] : published) {
        CAPTURE(loop, course.compliance(loop) / compliance - 1);
        CHECK(course.compliance(loop) == Approx(compliance).epsilon(5e-4));
    }
    CHECK(course.most_iterations <= 25);
}

}  // namespace topology_published_test
