// Homogenises samples one by one; a law's points are samples with other cell sizes.
#include "recipe/structure/foam_stiffness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elasticity/field_sample.h"
#include "recipe/build/build_job.h"
#include "recipe/build/foam_modulus.h"

namespace lamella {

namespace {

constexpr double elements_in_a_radius = 4;
constexpr int min_elements = 32, max_elements = 320, elements_step = 16;
constexpr double max_solid_elements = 1e6;  // keeps memory below 2 GiB

double constant_of(const GradedUse& use) {
    const auto number = use.made->constant();
    if (!number)
        throw InputError(use.key +
                         ": it varies in space, and a sample stands for one place; accepted: a number");
    return *number;
}

void refuse_formula(const char* key, const GradedNumber& number) {
    if (!number.is_formula()) return;
    throw InputError(
        fmt::format("{}: it varies in space, and a sample stands for one place; accepted: a number",
                    number.where.empty() ? key : number.where));
}

/// Returns true for kinds whose samples depend on the seed.
bool is_random(const FoamRecipe& foam) {
    const std::vector<std::string>& takes = builder_of(foam).kind.takes;
    return std::ranges::find(takes, "seed") != takes.end();
}

/// Returns the period of the foam with periodic seeds, mm.
double period_of(const Recipe& recipe) {
    const double side = 1;  // side of the region, mm; periods do not depend on it
    const double period = build_foam_alone(recipe, {dvec3(0), dvec3(side)}, 1).period;
    if (!(period > 0))
        throw InputError(
            "foam: with this stretch the foam is not periodic along x, y and z, as a sample must be; "
            "accepted: a foam without foam.stretch");
    return period;
}

/// Returns half the thickness of the thinnest walls, or the radius of the beams, mm.
double thinnest_radius(const BuiltFoam& foam) {
    const bool beams = foam.member.key == "foam.beam";
    double radius = constant_of(foam.member) / (beams ? 1 : 2);
    for (const GradedUse& other : foam.others) {
        if (other.key == "foam.wall") radius = std::min(radius, constant_of(other) / 2);
    }
    return radius;
}

ElementMask sample_of(const BuiltFoam& foam, double period, int elements, const StiffnessOptions& options) {
    ThreadArena arena(options.threads);
    return arena.execute([&] {
        return sample_field(*foam.field, {dvec3(0), dvec3(period)}, elements, options.cancel);
    });
}

int suited_elements(const BuiltFoam& foam, double period, const StiffnessOptions& options) {
    const double wanted = elements_in_a_radius * period / thinnest_radius(foam);
    const int steps = static_cast<int>(std::ceil(std::min(wanted, 1e6) / elements_step));
    constexpr int coarse = 64;
    const double share = std::max(sample_of(foam, period, coarse, options).share(), 1e-4);
    const int bearable = static_cast<int>(std::cbrt(max_solid_elements / share) / elements_step);
    return std::clamp(std::min(steps, bearable) * elements_step, min_elements, max_elements);
}

/// Returns the finished share of the work when the residual forces have fallen to `left`: they fall by about
/// the same factor with each iteration.
double share_done(double left, double tolerance) {
    return std::clamp(std::log(std::max(left, 1e-300)) / std::log(tolerance), 0.0, 1.0);
}

Homogenized homogenized(const ElementMask& sample, const StiffnessOptions& options) {
    HomogenizationOptions given{options.tolerance, 2000, options.threads, {}, options.cancel};
    if (options.on_progress)
        given.on_progress = [&](int, double left) {
            options.on_progress(share_done(left, options.tolerance));
        };
    return homogenize(sample, options.material, given);
}

int samples_of(const FoamRecipe& foam, const StiffnessOptions& options) {
    return is_random(foam) ? options.samples : 1;
}

/// Makes the foam of a sample.
BuiltFoam foam_of(Recipe recipe, int sample, double period) {
    recipe.foam->seed += sample;
    return build_foam_alone(recipe, {dvec3(0), dvec3(period)}, 1);
}

}  // namespace

double FoamStiffness::mean(double (*number)(const Homogenized&)) const {
    double sum = 0;
    for (const Homogenized& sample : samples) sum += number(sample);
    return sum / static_cast<double>(samples.size());
}

double FoamStiffness::spread(double (*number)(const Homogenized&)) const {
    if (samples.size() < 2) return 0;
    const double middle = mean(number);
    double sum = 0;
    for (const Homogenized& sample : samples) sum += std::pow(number(sample) - middle, 2);
    return std::sqrt(sum / static_cast<double>(samples.size() - 1));
}

ElasticTensor FoamStiffness::stiffness() const {
    ElasticTensor c{};
    for (const Homogenized& sample : samples) {
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j < 6; ++j)
                c[i][j] += sample.stiffness[i][j] / static_cast<double>(samples.size());
        }
    }
    return c;
}

double density_of(const Homogenized& sample) { return sample.density; }
double young_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).young; }
double poisson_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).poisson; }
double shear_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).shear(); }
double bulk_of(const Homogenized& sample) { return closest_isotropic(sample.stiffness).bulk(); }

void check_uniform(const FoamRecipe& foam) {
    refuse_formula("foam.cell", foam.cell);
    refuse_formula("foam.beam", foam.beam);
    refuse_formula("foam.wall", foam.wall);
    refuse_formula("foam.window", foam.window);
    refuse_formula("foam.modulus", foam.modulus);
}

FoamStiffness foam_stiffness(std::span<const SolvedSample> solved) {
    FoamStiffness all;
    for (const SolvedSample& sample : solved) {
        all.period = sample.period;
        all.elements = sample.elements;
        all.samples.push_back(sample.found);
    }
    return all;
}

std::vector<StiffnessSolve> foam_solves(const Recipe& recipe, const StiffnessOptions& options) {
    const int count = samples_of(*recipe.foam, options);
    std::vector<StiffnessSolve> solves;
    solves.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) solves.push_back({.sample = i, .work = 1.0 / count});
    return solves;
}

namespace {

constexpr std::size_t coarse_solves = 3;  // per point of a law: one for its own material, two for others

/// Returns the recipe with cells resized to the given ratio of members to cells, without a material.
Recipe with_ratio(Recipe recipe, double ratio) {
    FoamRecipe& foam = *recipe.foam;
    check_uniform(foam);
    GradedNumber& thickness = member_of(foam) == "beam" ? foam.beam : foam.wall;
    if (thickness.number() == 0) thickness.value = 1.0;  // it would follow from a modulus; any length will do
    foam.cell.value = thickness.number() / ratio;
    foam.cell_min = 0;
    foam.cell_max = infinity;
    foam.modulus = {};
    recipe.material.reset();
    return recipe;
}

/// Returns the elements along a coarse sample in which members are still connected.
int coarse_elements(const FoamRecipe& foam, double period) {
    constexpr double in_a_radius = 1.5, least = 64;
    const double radius = member_of(foam) == "beam" ? foam.beam.number() : foam.wall.number() / 2;
    return static_cast<int>(std::ceil(std::max(least, in_a_radius * period / radius) / elements_step)) *
           elements_step;
}

}  // namespace

SolvedSample solve_sample(const Recipe& given, const StiffnessSolve& solve, StiffnessOptions options) {
    const bool is_of_law = solve.ratio > 0;
    const Recipe recipe = is_of_law ? with_ratio(given, solve.ratio) : given;
    if (is_of_law) options.material = {1, solve.poisson};
    check_uniform(*recipe.foam);
    check_material(options.material);
    SolvedSample solved;
    solved.period = period_of(recipe);
    const auto fine_elements = [&](int sample) {
        if (options.elements > 0) return options.elements;
        return suited_elements(foam_of(recipe, sample, solved.period), solved.period, options);
    };
    // A coarse sample is at most as fine as the last fine sample of the law's point.
    solved.elements = solve.coarse ? std::min(fine_elements(samples_of(*recipe.foam, options) - 1),
                                              coarse_elements(*recipe.foam, solved.period))
                                   : fine_elements(solve.sample);
    const BuiltFoam foam = foam_of(recipe, solve.sample, solved.period);
    const ElementMask mask = sample_of(foam, solved.period, solved.elements, options);
    solved.found = homogenized(mask, options);
    return solved;
}

void check_law_point(const Recipe& recipe, double ratio) {
    try {
        period_of(with_ratio(recipe, ratio));
    } catch (const InputError& error) {
        throw InputError(fmt::format("a ratio of {:.4g}: {}", ratio, error.what()));
    }
}

std::vector<StiffnessSolve> law_solves(const Recipe& recipe, double ratio, const StiffnessOptions& options) {
    constexpr double coarse_work = 0.2;
    const int count = samples_of(*recipe.foam, options);
    std::vector<StiffnessSolve> solves;
    solves.reserve(static_cast<std::size_t>(count) + coarse_solves);
    for (int i = 0; i < count; ++i)
        solves.push_back({ratio, i, law_poisson, false, (1 - coarse_work) / count});
    // One coarse sample, the same for all three materials, shows the effect of Poisson's ratio.
    for (const double poisson : {law_poisson, low_poisson, high_poisson})
        solves.push_back({ratio, 0, poisson, true, coarse_work / coarse_solves});
    return solves;
}

FoamLawPoint law_point(double ratio, std::span<const SolvedSample> solved) {
    const auto coarse = solved.last(coarse_solves);
    const FoamStiffness found = foam_stiffness(solved.first(solved.size() - coarse_solves));
    FoamLawPoint point;
    point.ratio = ratio;
    point.density = found.mean(density_of);
    point.young = closest_isotropic(found.stiffness()).young;
    point.poisson = closest_isotropic(found.stiffness()).poisson;
    point.spread = found.spread(young_of) / found.mean(young_of);
    point.anisotropy = anisotropy(found.stiffness());
    point.elements = found.elements;
    point.samples = static_cast<int>(found.samples.size());
    const double middle = young_of(coarse[0].found);
    point.low_factor = young_of(coarse[1].found) / middle;
    point.high_factor = young_of(coarse[2].found) / middle;
    return point;
}

}  // namespace lamella
