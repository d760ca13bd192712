// Searches for elements: a known optimum, beams of sticks beside the free optimum, threads.
#include "procedural/elements/element_search.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elements/element_pieces.h"
#include "procedural/elements/element_start.h"
#include "procedural/optimization/element_stress.h"
#include "tests/procedural/optimization/topology_problems.h"

namespace element_optimizer_test {

using namespace lamella;

namespace {

/// The law of the search for elements.
std::shared_ptr<const ModulusLaw> element_law() { return make_penalty_law({3, 1e-6, 0}); }

CellGrid squares(int nx, int ny) { return {{nx, ny, 1}, dvec3(0), dvec3(1), true}; }

/// A half of an MBB beam of sticks, from the free optimum of their volume to one piece.
struct SticksBeam {
    static constexpr int nx = 120, ny = 40, fine = 4;
    static constexpr double length = 15.2, width = 3.2;
    ElementShapePtr stick = make_stick(length, width);
    std::vector<DistanceTable> tables{DistanceTable(*stick, 4, 128, true)};
    CellGrid grid = squares(nx, ny);
    TopologyProblem<2> problem;
    double optimum = 0;
    JoinedElements joined;

    SticksBeam(std::size_t count, std::uint64_t seed, int iterations) : problem(half_mbb_beam(nx, ny, 0.5)) {
        problem.volume = static_cast<double>(count) * tables[0].content() / (nx * ny);
        TopologySettings free;
        free.density.radius = 1.5;
        free.iterations = 60;
        free.sharpness = 16;
        TopologyOptimizer<2> search(problem, free);
        while (!search.is_finished()) search.iterate();
        optimum = search.analyse().total;
        search.show_design();
        const auto densities = search.densities().density(DensityMap::Role::result);
        const auto stresses =
            greatest_principal_stresses(problem.body, 0.3, search.compliance().displacements(0));
        std::vector<dvec3> ways;
        for (const std::size_t number : element_numbers(problem.body.grid))
            ways.push_back(stresses[number].way);
        problem.law = element_law();
        TopologyProblem<2> finer = half_mbb_beam(2 * nx, 2 * ny, 0.5);
        finer.law = element_law();
        const ElementSearchGrid<2> on_coarse{&problem, grid, tables},
            on_fine{&finer, {{2 * nx, 2 * ny, 1}, dvec3(0), dvec3(0.5), true}, tables};
        ElementSettings settings{.iterations = iterations, .seed = seed};
        const int begin = coarse_iterations(iterations);
        FoundElements found =
            search_elements(on_coarse, settings, begin,
                            sampled_elements(grid, densities, ways, {.count = count, .seed = seed}));
        settings.begin = begin;
        found = search_elements(on_fine, settings, iterations, found.elements);
        joined = join_elements(found.elements, found.loads, std::vector{stick},
                               {.hold = 0.25, .reach = width, .is_flat = true});
    }

    /// The true shapes on finer elements, solid or void: compliance over that of the optimum, both over that
    /// of a solid beam on their own grid.
    double true_compliance() const {
        TopologyProblem<2> finer = half_mbb_beam(fine * nx, fine * ny, 0.5);
        finer.law = make_penalty_law({1, 1e-9, 0});
        Compliance<2> analysis(finer, {.tolerance = 1e-6, .max_iterations = 5000}),
            coarse(problem, {.tolerance = 1e-6});
        std::vector<double> shape;
        for (int y = 0; y < fine * ny; ++y) {
            for (int x = 0; x < fine * nx; ++x) {
                const dvec3 p((x + 0.5) / fine, (y + 0.5) / fine, 0);
                const auto holds = [&](const PlacedElement& e) {
                    dvec3 local = e.local(p);
                    local.z = 0;
                    return stick->distance(local) < 0;
                };
                shape.push_back(std::ranges::any_of(joined.elements, holds) ? 1 : 0);
            }
        }
        const double made = analysis.evaluate(shape).total;
        const std::vector<double> solid(shape.size(), 1.0), coarse_solid(problem.use.size(), 1.0);
        return made / analysis.evaluate(solid).total * coarse.evaluate(coarse_solid).total / optimum;
    }
};

}  // namespace

TEST_CASE("two bars find the angle of the stiffest truss", "[elements]") {
    // Two equal bars from a wall to a load across, 30 mm apart from it: the compliance goes with
    // 1 / (sin^2 a cos a), whose least is at tan a = sqrt 2.
    constexpr int nx = 30, ny = 100;
    TopologyProblem<2> problem = plane_cantilever(nx, ny, 0.5, ny / 2);
    problem.law = element_law();
    const CellGrid grid = squares(nx, ny);
    const std::vector<DistanceTable> tables{DistanceTable(*make_stick(58, 4), 4, 200, true)};
    const double start = GENERATE(0.6, 1.15);
    std::vector<PlacedElement> bars;
    for (const double side : {-1.0, 1.0}) {
        const dvec3 way(std::cos(start), side * std::sin(start), 0);
        bars.push_back({.shape = 0, .at = dvec3(nx, 0.5 * ny, 0) - 27.0 * way, .turn = turn_to(way)});
    }
    ElementOptimizer<2> search(problem, grid, tables, {.overlap = 0.6, .iterations = 80}, bars);
    while (!search.is_finished()) search.iterate();
    for (const PlacedElement& bar : search.elements()) {
        const dvec3 way = bar.turn * dvec3(1, 0, 0);
        const double angle = std::atan2(std::abs(way.y), std::abs(way.x)) * 180 / pi;
        CAPTURE(start);
        CHECK(angle == Approx(std::atan(std::sqrt(2.0)) * 180 / pi).margin(1));
    }
}

TEST_CASE("a beam of sticks is one piece and nearly as stiff as the free optimum", "[elements]") {
    const SticksBeam beam(45, GENERATE(as<std::uint64_t>{}, 1, 2), 80);
    CAPTURE(beam.joined.pieces, beam.joined.moved, beam.joined.dropped);
    CHECK(beam.joined.elements.size() == 45);
    CHECK(beam.true_compliance() < 1.5);
}

TEST_CASE("the gradient of the compliance is that of differences, once elements carry", "[elements]") {
    const SticksBeam beam(30, 3, 20);
    const auto compliance_of = [&](const std::vector<PlacedElement>& elements, ElementRaster& raster) {
        raster.set(elements);
        Compliance<2> analysis(beam.problem, {.tolerance = 1e-12, .max_iterations = 20000});
        return analysis.evaluate(raster.densities());
    };
    ElementRaster raster(beam.grid, beam.problem.use, beam.tables, 1.5, 0.25);
    const std::vector<PlacedElement>& elements = beam.joined.elements;
    const auto found = compliance_of(elements, raster);
    const std::vector<ElementGradient> gradients = raster.gradients(found.gradient, 0);
    constexpr double step = 1e-6;  // short of the kinks where densities reach 1
    double largest = 0;
    for (std::size_t k = 0; k < elements.size(); k += 7) {
        const auto slope = [&](const auto& change) {
            std::vector<PlacedElement> more = elements, less = elements;
            change(more[k], step);
            change(less[k], -step);
            ElementRaster other = raster;
            return (compliance_of(more, other).total - compliance_of(less, other).total) / (2 * step);
        };
        const double x = slope([](PlacedElement& e, double by) { e.at.x += by; });
        const double y = slope([](PlacedElement& e, double by) { e.at.y += by; });
        const double turn = slope([](PlacedElement& e, double by) { e = turned(e, {0, 0, by}); });
        const double margin = 1e-5 * found.total;
        CHECK(gradients[k].at.x == Approx(x).epsilon(1e-5).margin(margin));
        CHECK(gradients[k].at.y == Approx(y).epsilon(1e-5).margin(margin));
        CHECK(gradients[k].turn.z == Approx(turn).epsilon(1e-5).margin(margin));
        largest = std::max({largest, std::abs(x), std::abs(y), std::abs(turn)});
    }
    CHECK(largest > 100 * 1e-5 * found.total);
}

TEST_CASE("a problem that is turned with its elements is as stiff", "[elements]") {
    constexpr int nx = 48, ny = 30, at_y = 9;
    const std::vector<DistanceTable> tables{DistanceTable(*make_stick(14, 4), 4, 160, true)};
    TopologyProblem<2> upright = plane_cantilever(nx, ny, 0.5, at_y),
                       turned_left = free_box<2>({ny, nx, 1}, 0.5, 0);
    for (int x = 0; x <= ny; ++x) turned_left.body.fixed[turned_left.body.grid.number(x, 0, 0)] = 3;
    turned_left.cases[0].forces.along[0][turned_left.body.grid.number(ny - at_y, nx, 0)] = 1;
    upright.law = turned_left.law = element_law();
    const std::vector<double> even(upright.use.size(), 1.0);
    const std::vector<PlacedElement> elements =
        sampled_elements(squares(nx, ny), even, {}, {.count = 40, .seed = 4});
    std::vector<PlacedElement> moved = elements;
    for (PlacedElement& e : moved) {
        e.at = {ny - e.at.y, e.at.x, e.at.z};
        e.turn = turn_to(dvec3(0, 1, 0)) * e.turn;
    }
    const auto compliance_of = [&](const TopologyProblem<2>& problem, const CellGrid& grid,
                                   const std::vector<PlacedElement>& placed) {
        ElementRaster raster(grid, problem.use, tables, 1.5, 0.25);
        raster.set(placed);
        Compliance<2> analysis(problem, {.tolerance = 1e-9, .max_iterations = 20000});
        return analysis.evaluate(raster.densities()).total;
    };
    CHECK(compliance_of(turned_left, squares(ny, nx), moved) ==
          Approx(compliance_of(upright, squares(nx, ny), elements)).epsilon(1e-4));
}

TEST_CASE("elements do not depend on threads", "[elements]") {
    std::vector<PlacedElement> one;
    for (const int threads : {1, 3}) {
        ThreadArena arena(threads);
        const std::vector<PlacedElement> found =
            arena.execute([] { return SticksBeam(30, 5, 12).joined.elements; });
        if (threads == 1) one = found;
        CHECK(found == one);
    }
}

TEST_CASE("scales stay within their limits and the content", "[elements]") {
    TopologyProblem<2> problem = plane_cantilever(60, 40, 0.4, 20);
    problem.law = element_law();
    const CellGrid grid = squares(60, 40);
    const std::vector<DistanceTable> tables{DistanceTable(*make_stick(12, 3), 6, 128, true)};
    const std::vector<double> even(problem.use.size(), 1.0);
    const Interval limits{0.7, 1.3};
    ElementOptimizer<2> search(problem, grid, tables, {.overlap = 0.3, .scale = limits, .iterations = 60},
                               sampled_elements(grid, even, {}, {.count = 24, .scale = limits}));
    const double first = search.iterate().compliance;
    double last = first;
    while (!search.is_finished()) last = search.iterate().compliance;
    CHECK(last < 0.5 * first);
    double content = 0, least = 2, most = 0;
    for (const PlacedElement& element : search.elements()) {
        content += element.scale * element.scale;
        least = std::min(least, element.scale);
        most = std::max(most, element.scale);
    }
    CHECK(content <= 24 * 1.02);
    CHECK(least >= 0.7);
    CHECK(most <= 1.3);
    CHECK(most - least > 0.2);
}

TEST_CASE("a search in two parts is that in one", "[elements]") {
    TopologyProblem<2> problem = plane_cantilever(40, 20, 0.4, 10);
    problem.law = element_law();
    const std::vector<DistanceTable> tables{DistanceTable(*make_stick(12, 4), 4, 96, true)};
    const std::vector<double> even(problem.use.size(), 1.0);
    const std::vector<PlacedElement> start =
        sampled_elements(squares(40, 20), even, {}, {.count = 12, .seed = 2});
    ElementSettings settings{.iterations = 15};
    const ElementSearchGrid<2> grid{&problem, squares(40, 20), tables, 2};
    std::vector<int> told;
    double last = 0;
    const auto tell = [&](const ElementIteration& done) {
        told.push_back(done.index);
        last = done.compliance;
    };
    CHECK(coarse_iterations(15) == 9);
    const FoundElements first = search_elements(grid, settings, 9, start, tell);
    settings.begin = 9;
    search_elements(grid, settings, 15, first.elements, tell);
    CHECK(told == std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    // The second part begins with the elements that the first one has taken last.
    ElementOptimizer<2> alone(problem, grid.cells, tables, {.iterations = 15}, start);
    for (int k = 0; k < 9; ++k) alone.iterate();
    CHECK(alone.elements() == first.elements);
    CHECK(alone.loads() == first.loads);
    ElementOptimizer<2> on(problem, grid.cells, tables, settings, first.elements);
    double compliance = 0;
    while (!on.is_finished()) compliance = on.iterate().compliance;
    CHECK(last == 2 * compliance);
}

TEST_CASE("a search without elements is refused", "[elements]") {
    TopologyProblem<2> problem = plane_cantilever(20, 10, 0.4, 5);
    const std::vector<DistanceTable> tables{DistanceTable(*make_stick(8, 3), 4, 64, true)};
    CHECK_THROWS_AS(ElementOptimizer<2>(problem, squares(20, 10), tables, {}, {}), InputError);
}

}  // namespace element_optimizer_test
