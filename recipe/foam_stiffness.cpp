// Samples one by one; a law's points by cells of other sizes.
#include "recipe/foam_stiffness.h"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "procedural/field_sample.h"
#include "recipe/build_job.h"
#include "recipe/foam_modulus.h"

namespace lamella {

namespace {

constexpr double elements_in_a_radius = 4;
constexpr int least_elements = 32, most_elements = 320, elements_step = 16;
constexpr double most_solid_elements = 1e6;  // for memory below 2 GiB

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

/// A kind whose sample would look another way with another seed.
bool is_random(const FoamRecipe& foam) {
    const std::vector<std::string>& takes = builder_of(foam).kind.takes;
    return std::ranges::find(takes, "seed") != takes.end();
}

/// After how much the foam repeats, mm, once its seeds are made to.
double period_of(const Recipe& recipe) {
    const double side = 1;  // of the region: periods do not depend on it
    const double period = build_foam_alone(recipe, {dvec3(0), dvec3(side)}, 1).period;
    if (!(period > 0))
        throw InputError("foam: with this stretch it does not repeat along x, y and z, as a sample has to");
    return period;
}

/// Half the thickness of the thinnest walls or the radius of the beams, mm.
double thinnest_radius(const BuiltFoam& foam) {
    const bool beams = foam.member.key == "foam.beam";
    double radius = constant_of(foam.member) / (beams ? 1 : 2);
    for (const GradedUse& other : foam.others) {
        if (other.key == "foam.wall") radius = std::min(radius, constant_of(other) / 2);
    }
    return radius;
}

ElementMask sample_of(const BuiltFoam& foam, double period, int elements, int threads) {
    oneapi::tbb::task_arena arena(threads > 0 ? threads : oneapi::tbb::task_arena::automatic);
    return arena.execute([&] { return sample_field(*foam.field, {dvec3(0), dvec3(period)}, elements); });
}

int suited_elements(const BuiltFoam& foam, double period, int threads) {
    const double wanted = elements_in_a_radius * period / thinnest_radius(foam);
    const int steps = static_cast<int>(std::ceil(std::min(wanted, 1e6) / elements_step));
    constexpr int coarse = 64;
    const double share = std::max(sample_of(foam, period, coarse, threads).share(), 1e-4);
    const int bearable = static_cast<int>(std::cbrt(most_solid_elements / share) / elements_step);
    return std::clamp(std::min(steps, bearable) * elements_step, least_elements, most_elements);
}

/// The share of the work that is done when the forces that are left have fallen to `left`: they fall by
/// about the same factor with each iteration.
double share_done(double left, double tolerance) {
    return std::clamp(std::log(std::max(left, 1e-300)) / std::log(tolerance), 0.0, 1.0);
}

Homogenized homogenized(const ElementMask& sample, const StiffnessOptions& options, double from, double to) {
    HomogenizationOptions given{options.tolerance, 2000, options.threads, {}, options.cancel};
    if (options.on_progress) {
        given.on_progress = [&](int, double left) {
            options.on_progress(from + (to - from) * share_done(left, options.tolerance));
        };
    }
    return homogenize(sample, options.material, given);
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

FoamStiffness foam_stiffness(const Recipe& recipe, const StiffnessOptions& options) {
    check_uniform(*recipe.foam);
    check_material(options.material);
    FoamStiffness found;
    found.period = period_of(recipe);
    const int count = is_random(*recipe.foam) ? options.samples : 1;
    Recipe other = recipe;
    for (int i = 0; i < count; ++i, ++other.foam->seed) {
        const BuiltFoam foam = build_foam_alone(other, {dvec3(0), dvec3(found.period)}, 1);
        found.elements =
            options.elements > 0 ? options.elements : suited_elements(foam, found.period, options.threads);
        const ElementMask sample = sample_of(foam, found.period, found.elements, options.threads);
        const double whole = count;
        found.samples.push_back(homogenized(sample, options, i / whole, (i + 1) / whole));
    }
    return found;
}

namespace {

/// The recipe with cells so large that the members' ratio to them is as given, in no material.
Recipe with_ratio(Recipe recipe, double ratio) {
    FoamRecipe& foam = *recipe.foam;
    check_uniform(foam);
    GradedNumber& thickness = member_of(foam) == "beam" ? foam.beam : foam.wall;
    if (thickness.number() == 0) thickness.value = 1.0;  // a modulus would have chosen it
    foam.cell.value = thickness.number() / ratio;
    foam.cell_min = 0;
    foam.cell_max = infinity;
    foam.modulus = {};
    recipe.material.reset();
    return recipe;
}

}  // namespace

void check_law_point(const Recipe& recipe, double ratio) {
    try {
        period_of(with_ratio(recipe, ratio));
    } catch (const InputError& error) {
        throw InputError(fmt::format("a ratio of {:.4g}: {}", ratio, error.what()));
    }
}

FoamLawPoint law_point(const Recipe& given, double ratio, StiffnessOptions options) {
    const Recipe recipe = with_ratio(given, ratio);
    const FoamRecipe& foam = *recipe.foam;
    const bool beams = member_of(foam) == "beam";
    options.material = {1, law_poisson};
    const auto progress = std::move(options.on_progress);
    const auto part = [&](double from, double to) {
        options.on_progress = [&progress, from, to](double share) {
            if (progress) progress(from + (to - from) * share);
        };
    };
    part(0, 0.8);
    const FoamStiffness found = foam_stiffness(recipe, options);
    FoamLawPoint point;
    point.ratio = ratio;
    point.density = found.mean(density_of);
    point.young = closest_isotropic(found.stiffness()).young;
    point.poisson = closest_isotropic(found.stiffness()).poisson;
    point.spread = found.spread(young_of) / found.mean(young_of);
    point.anisotropy = anisotropy(found.stiffness());
    point.elements = found.elements;
    point.samples = static_cast<int>(found.samples.size());
    // What the material's Poisson's ratio changes is told by one coarse sample, the same for all three,
    // whose members still hang together.
    constexpr double elements_in_a_coarse_radius = 1.5, least = 64;
    const double radius = beams ? foam.beam.number() : foam.wall.number() / 2,
                 coarse = std::max(least, elements_in_a_coarse_radius * found.period / radius);
    options.elements =
        std::min(found.elements, static_cast<int>(std::ceil(coarse / elements_step)) * elements_step);
    options.samples = 1;
    const auto young_with = [&](double poisson, double from, double to) {
        options.material.poisson = poisson;
        part(from, to);
        return foam_stiffness(recipe, options).mean(young_of);
    };
    const double middle = young_with(law_poisson, 0.8, 0.87);
    point.low_factor = young_with(low_poisson, 0.87, 0.93) / middle;
    point.high_factor = young_with(high_poisson, 0.93, 1) / middle;
    return point;
}

}  // namespace lamella
