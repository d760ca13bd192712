// Neighbours are tried four at a time, at right angles to each other.
#include "recipe/placement/plan_orientations.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/base/deterministic_math.h"
#include "engine/base/parallel.h"

namespace lamella {

namespace {

/// Plans the supports of some orientations side by side.
void plan(const LaidPart& part, const OrientOptions& options, std::span<Orientation> orientations) {
    const int threads =
        std::max(1, thread_count(options.threads) / std::max(1, static_cast<int>(orientations.size())));
    parallel_for(orientations.size(), [&](std::size_t i) {
        orientations[i].planned = part.support_volume(orientations[i].lay_on, threads, options.cancel);
    });
}

double planned(const Orientation& orientation) { return orientation.planned.value_or(infinity); }

/// Estimates this many times the material of a plan are never planned: estimates of a dozen models were at
/// most 72 times too large.
constexpr double hopeless = 100;

double least_planned(std::span<const Orientation> orientations) {
    double least = infinity;
    for (const Orientation& orientation : orientations) least = std::min(least, planned(orientation));
    return least;
}

/// Spends plans on the neighbours of the list's `start`. Returns the number of plans that are left.
std::size_t plan_neighbours(const LaidPart& part, const OrientationMeasure& measure,
                            const OrientOptions& options, std::size_t start, std::size_t plans,
                            std::vector<Orientation>& list) {
    constexpr double degree = std::numbers::pi / 180;
    Orientation best = list[start];
    double turn = 0;  // of the four ways, so that they are not always the same
    for (double step = 4; step >= 0.5 && plans > 0;) {
        const dvec3 up = best.figures.up;
        const auto [a, b] = across(up);
        std::vector<Orientation> tried;
        for (std::size_t k = 0; k < std::min<std::size_t>(4, plans); ++k) {
            const double angle = turn + static_cast<double>(k) * std::numbers::pi / 2;
            const SineCosine turned = sine_cosine(angle);
            const dvec3 way = turned.cosine * a + turned.sine * b;
            tried.push_back(measure(glm::normalize(up + std::tan(step * degree) * way)));
        }
        plan(part, options, tried);
        plans -= tried.size();
        list.insert(list.end(), tried.begin(), tried.end());
        const auto found = std::ranges::min_element(tried, {}, planned);
        if (planned(*found) < planned(best)) {
            best = *found;
        } else {
            step /= 2;
            turn += std::numbers::pi / 4;
        }
    }
    return plans;
}

}  // namespace

std::size_t affordable_plans(const PlanCost& cost) {
    // Seconds of both cores: the survey follows outlines, and each plan sorts the triangles.
    constexpr double of_outline = 3e-6, of_triangle = 1.5e-6, of_sampling = 25, all = 6;
    const double outlines =
        of_outline * cost.surface / cost.layer_height * (cost.is_sampled ? of_sampling : 1);
    const double one = 0.01 + outlines + of_triangle * static_cast<double>(cost.triangles);
    return static_cast<std::size_t>(std::clamp(all / one, 3.0, 60.0));
}

void plan_orientations(const LaidPart& part, std::size_t plans, const OrientationMeasure& measure,
                       const OrientOptions& options, std::vector<Orientation>& list) {
    // Few plans all go to orientations that differ.
    const std::size_t near_best = plans < 6 ? 0 : plans / 3;
    const std::size_t most = std::min(plans - near_best, list.size());
    const std::size_t sure = std::min<std::size_t>(most, 3);
    plan(part, options, std::span(list).first(sure));
    const auto rest = std::span(list).subspan(sure, most - sure);
    const double limit = hopeless * least_planned(std::span(list).first(sure));
    const auto end = std::ranges::find_if(
        rest, [&](const Orientation& other) { return other.figures.support_volume > limit; });
    const auto hopeful = static_cast<std::size_t>(end - rest.begin());
    plan(part, options, rest.first(hopeful));
    const std::size_t first = sure + hopeful;
    std::size_t left = plans - most;
    for (std::size_t start = 0; start < first && left > 0 && near_best > 0; ++start) {
        std::ranges::stable_sort(list, {}, planned);
        left = plan_neighbours(part, measure, options, start, left, list);
    }
    std::ranges::stable_sort(list, {}, planned);
}

}  // namespace lamella
