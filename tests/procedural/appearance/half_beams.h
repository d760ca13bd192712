// Beams and pictures made in code for the tests of structure and appearance optimisation.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "procedural/appearance/appearance.h"
#include "procedural/appearance/appearance_optimizer.h"

namespace half_beams {

using namespace lamella;

/// Half of a beam on two supports with a load in its middle, the left edge.
inline TopologyProblem<2> half_beam(glm::ivec3 size) {
    TopologyProblem<2> problem{.body =
                                   ElasticBody<2>(NodeGrid<2>(size), make_plane_stress_element({1, 0.4}))};
    const NodeGrid<2>& grid = problem.body.grid;
    for (int y = 0; y <= size.y; ++y) problem.body.fixed[grid.number(0, y, 0)] |= 1;
    problem.body.fixed[grid.number(size.x, 0, 0)] |= 2;
    problem.use.assign(static_cast<std::size_t>(size.x * size.y), ElementUse::free);
    problem.cases.push_back({"1", 1, NodalVector<2, double>(grid.size())});
    problem.cases[0].forces.along[1][grid.number(0, size.y, 0)] = -1;
    problem.law = make_penalty_law({});
    return problem;
}

inline TopologyProblem<2> half_beam_at(glm::ivec3 size, int) { return half_beam(size); }

/// Black and white, four pixels an element of the finest grid, 32 elements across.
template <class Solid>
GreyImage drawn(const Solid& is_solid) {
    GreyImage image(128, 128);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x)
            image.values[image.index(x, y)] = is_solid(0.25 * (x + 0.5), 0.25 * (y + 0.5)) ? 1 : 0;
    }
    return image;
}

inline GreyImage stripes() {
    return drawn([](double x, double y) { return std::fmod(x + y, 8) < 3; });
}

inline GreyImage rings() {
    return drawn([](double x, double y) {
        const auto from_lattice = [](double v) { return std::abs(v - 12 * std::round(v / 12)); };
        const double r = std::hypot(from_lattice(x), from_lattice(y));
        return r > 3 && r < 6.2;
    });
}

inline constexpr int exemplar_width = 32;

inline AppearanceSettings quick(double compliance) {
    AppearanceSettings settings;
    settings.compliance = compliance;
    settings.levels = 2;
    settings.match.neighbourhood = 8;
    return settings;
}

/// What a search ends with, and its steps.
struct Found : AppearanceResult {
    std::vector<AppearanceStep> history;
};

inline Found optimized(AppearanceOptimizer& optimizer) {
    std::vector<AppearanceStep> history;
    while (!optimizer.is_finished()) history.push_back(optimizer.iterate());
    return {optimizer.result(), std::move(history)};
}

inline Found optimized(const PlaneProblemMaker& problem, glm::ivec3 size, const GreyImage& exemplar,
                       int width, const AppearanceSettings& settings) {
    AppearanceOptimizer optimizer(problem, size, exemplar, width, settings);
    return optimized(optimizer);
}

/// Checks that two results are the same to the last bit.
inline void check_same(const AppearanceResult& found, const AppearanceResult& wanted) {
    CHECK(found.design == wanted.design);
    CHECK(found.density == wanted.density);
    CHECK(found.filtered == wanted.filtered);
    CHECK(found.stiffest == wanted.stiffest);
    CHECK(found.appearance == wanted.appearance);
    CHECK(found.compliance == wanted.compliance);
    CHECK(found.least_compliance == wanted.least_compliance);
    CHECK(found.stiffest_appearance == wanted.stiffest_appearance);
}

/// A by matches that are found from scratch.
inline double likeness(const std::vector<double>& density, glm::ivec3 size, const GreyImage& exemplar) {
    Appearance appearance(box_filtered(exemplar, exemplar_width), size.x, size.y, quick(1).match);
    appearance.match(density);
    return appearance.energy(density);
}

inline double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

inline double compliance_of(const std::vector<double>& density, const TopologyProblem<2>& problem) {
    return Compliance<2>(problem, {.tolerance = 1e-8}).evaluate(density).total;
}

}  // namespace half_beams
