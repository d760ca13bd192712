// One analysis a round; bars by the displacements of their ends.
#include "procedural/pattern/force_bridges.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "engine/base/parallel.h"
#include "procedural/elasticity/direct_solver.h"
#include "procedural/optimization/density_shape.h"
#include "procedural/optimization/topology_problem.h"
#include "procedural/pattern/gap_crossings.h"

namespace lamella {

namespace {

constexpr double tolerance = 1e-3;
constexpr double most_direct_work = 4e9;  // multiplications, some seconds: beyond, multigrid is quicker
constexpr double least_share = 0.05;      // of an element that is in the body
constexpr std::size_t most_bars = 60;     // a round
constexpr double wanted_softness = 3;     // compliance over that of the closed skin
constexpr double least_gain = 0.02;       // of the compliance, in two rounds
constexpr double most_solid = 1.05;       // over that with bridges by shape alone

/// Elements that are hardly solid are left out: they would hang on others by corners.
std::vector<float> carrying(std::vector<float> shares) {
    for (float& share : shares) {
        if (static_cast<double>(share) < least_share) share = 0;
    }
    return shares;
}

}  // namespace

/// A skin under its loads: displacements and compliances, and a solver for more.
struct BridgesByForces::Analysis {
    std::vector<float> shares;
    LoadedSkin loaded;
    std::unique_ptr<DirectSolver> direct;
    std::optional<ElasticSolver<3>> multigrid;
    std::vector<NodalVector<3, double>> displacements;
    std::vector<double> compliances;

    Analysis(std::vector<float> of_elements, bool is_closed, const SkinElements& elements,
             const SkinLoads& loads, const CancelToken* cancel)
        : shares(std::move(of_elements)), loaded(loads(elements, shares)) {
        const std::vector<std::size_t> numbers = element_numbers(loaded.body.grid);
        std::vector<double> moduli(loaded.body.grid.size(), 0);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (loaded.body.present[numbers[i]] != 0) moduli[numbers[i]] = static_cast<double>(shares[i]);
        }
        if (!is_closed) direct = DirectSolver::make(loaded.body, moduli, most_direct_work);
        if (!direct) {
            multigrid.emplace(loaded.body, ElasticSolverOptions{.tolerance = tolerance, .cancel = cancel});
            multigrid->set_moduli(std::move(moduli));
        }
        for (const NodalVector<3, double>& forces : loaded.cases) {
            displacements.push_back(solve(forces));
            compliances.push_back(work(forces, displacements.back()));
        }
    }

    NodalVector<3, double> solve(const NodalVector<3, double>& forces) {
        if (direct) return direct->solve(forces);
        NodalVector<3, double> displacements_found(loaded.body.grid.size());
        multigrid->solve(forces, displacements_found);
        return displacements_found;
    }
    static double work(const NodalVector<3, double>& forces, const NodalVector<3, double>& u) {
        double sum = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::size_t i = 0; i < u.along[d].size(); ++i) sum += forces.along[d][i] * u.along[d][i];
        }
        return sum;
    }

    /// Returns the number of a cube's lowest node.
    std::size_t node_of(std::uint32_t cube) const {
        const glm::ivec3 at = DensityGrid{loaded.body.grid.elements(), {}, {}}.element(cube);
        return loaded.body.grid.number(at.x, at.y, at.z);
    }
    bool holds(std::uint32_t cube) const {
        return cube != SkinElements::none && loaded.body.present[node_of(cube)] != 0;
    }
    /// Calls visit(node) for the corners of a cube.
    template <typename Visit>
    void for_each_corner(std::uint32_t cube, const Visit& visit) const {
        const auto low = static_cast<std::ptrdiff_t>(node_of(cube));
        for (const std::ptrdiff_t step : loaded.body.grid.corner_steps())
            visit(static_cast<std::size_t>(low + step));
    }
    /// Returns how far the loads of a case move the ends of a bar apart: the means over the corners of cubes.
    double stretch(const NodalVector<3, double>& u, const Bar& bar) const {
        double sum = 0;
        const auto add = [&](std::uint32_t cube, double sign) {
            for_each_corner(cube, [&](std::size_t node) {
                sum += sign * (bar.way.x * u.along[0][node] + bar.way.y * u.along[1][node] +
                               bar.way.z * u.along[2][node]);
            });
        };
        add(bar.to, 0.125);
        add(bar.from, -0.125);
        return sum;
    }
    /// Returns how far unit forces push the ends of a bar apart.
    double flexibility(const Bar& bar) {
        NodalVector<3, double> forces(loaded.body.grid.size());
        for (int axis = 0; axis < 3; ++axis) {
            auto& along = forces.along[static_cast<std::size_t>(axis)];
            for_each_corner(bar.from, [&](std::size_t node) { along[node] -= 0.125 * bar.way[axis]; });
            for_each_corner(bar.to, [&](std::size_t node) { along[node] += 0.125 * bar.way[axis]; });
        }
        return stretch(solve(forces), bar);
    }
    /// Returns the gain of a bar, over the compliance, summed over the cases.
    double gain(const Bar& bar, double flexibility_of_ends) const {
        double sum = 0;
        for (std::size_t i = 0; i < displacements.size(); ++i)
            sum += gain_of_bar(bar.stiffness, stretch(displacements[i], bar), flexibility_of_ends) /
                   compliances[i];
        return sum;
    }
};

BridgesByForces::BridgesByForces(const SurfaceSites& sites, const SkinElements& elements,
                                 const SkinLoads& loads, const ForceSettings& settings)
    : sites_(sites), elements_(elements), loads_(loads), settings_(settings) {
    closed_ =
        Analysis(carrying(elements.shares({})), true, elements, loads, settings.by_shape.cancel).compliances;
}

/// Returns the bars over gaps by the bound of their gain for their length, the best first.
std::vector<BridgesByForces::Bar> BridgesByForces::possible_bars(const GapCrossings& gaps,
                                                                 const Analysis& analysis) const {
    const std::vector<std::uint32_t> cubes = elements_.cubes_of_sites(analysis.shares, least_share);
    std::vector<Bar> bars;
    for (const GapCrossing& c : gaps.all()) {
        if (c.width > settings_.by_shape.widest_gap * settings_.by_shape.strut) continue;
        Bar bar{&c, cubes[c.from], cubes[c.to], sites_.way(sites_.places[c.from], sites_.places[c.to])};
        if (bar.from == bar.to || !analysis.holds(bar.from) || !analysis.holds(bar.to)) continue;
        const double span = length(bar.way);
        bar.way /= span;
        bar.stiffness = settings_.by_shape.strut * settings_.thickness / (elements_.edge() * span);
        bar.score = analysis.gain(bar, 0) / (span + settings_.by_shape.strut);
        bars.push_back(bar);
    }
    std::ranges::stable_sort(bars, std::greater<>(), &Bar::score);
    return bars;
}

/// Keeps the best bars that lie apart, and scores them by their true gain. Where multigrid converges well,
/// the ends of bars are held firmly, and the bound of the gain does for it.
void BridgesByForces::solve_best(Analysis& analysis, std::vector<Bar>& bars) const {
    SitesApart apart(sites_, settings_.by_shape.apart);
    std::vector<Bar> best;
    for (const Bar& bar : bars) {
        if (best.size() == most_bars) break;
        if (!apart.is_free(bar.crossing->middle_from)) continue;
        apart.take(bar.crossing->middle_from);
        best.push_back(bar);
    }
    parallel_for(analysis.direct ? best.size() : 0, [&](std::size_t i) {
        stop_if_cancelled(settings_.by_shape.cancel);
        Bar& bar = best[i];
        bar.score =
            analysis.gain(bar, analysis.flexibility(bar)) / (bar.crossing->width + settings_.by_shape.strut);
    });
    bars = std::move(best);
    std::ranges::stable_sort(bars, std::greater<>(), &Bar::score);
}

/// Returns whether the bridges of the last two rounds gained hardly anything.
bool BridgesByForces::has_stalled() const {
    const std::size_t count = softness_.size();
    return count > 2 && softness_[count - 1] > (1 - least_gain) * softness_[count - 3];
}

std::vector<SiteLine> BridgesByForces::choose(std::span<const float> distances) {
    constexpr int most_rounds_by_shape = 4;
    if (rounds_by_shape_ < most_rounds_by_shape) {
        std::vector<SiteLine> by_shape = plan_bridges(sites_, distances, settings_.by_shape).bridges;
        rounds_by_shape_ = by_shape.empty() ? most_rounds_by_shape : rounds_by_shape_ + 1;
        if (!by_shape.empty()) return by_shape;
    }
    Analysis analysis(carrying(elements_.shares(distances)), false, elements_, loads_,
                      settings_.by_shape.cancel);
    double softness = 0;
    for (std::size_t i = 0; i < closed_.size(); ++i) softness += analysis.compliances[i] / closed_[i];
    softness /= static_cast<double>(closed_.size());
    softness_.push_back(softness);
    const auto solid = static_cast<std::size_t>(
        std::ranges::count_if(distances, [](float distance) { return distance > 0; }));
    if (softness_.size() == 1) solid_at_first_ = solid;
    if (softness <= wanted_softness || has_stalled() ||
        static_cast<double>(solid) > most_solid * static_cast<double>(solid_at_first_))
        return {};
    const GapCrossings gaps(sites_, distances);
    std::vector<Bar> bars = possible_bars(gaps, analysis);
    solve_best(analysis, bars);
    std::vector<SiteLine> chosen;
    for (const Bar& bar : bars) {
        constexpr double worth = 0.05;  // of the best bar's score
        if (bar.score < worth * bars.front().score) break;
        chosen.push_back(gaps.line(*bar.crossing));
    }
    return chosen;
}

}  // namespace lamella
