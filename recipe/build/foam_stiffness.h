// How stiff the foam of a recipe is: samples of it that repeat, homogenised.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "procedural/elasticity/foam_law.h"
#include "procedural/elasticity/homogenization.h"
#include "recipe/recipe.h"

namespace lamella {

struct StiffnessOptions {
    int elements = 0;  ///< along a sample's side; 0: four along the radius of the thinnest member, 32 to 320
                       ///< and about a million of them solid at most
    int samples = 1;   ///< of a random foam, each of 64 cells or more; of foams without chance one is made
    IsotropicMaterial material{};
    double tolerance = 1e-6;  ///< as HomogenizationOptions
    int threads = 0;          ///< 0: one per core
    /// Told how much of a solve is done, 0 to 1; may be empty.
    std::function<void(double share)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// What was found of all samples.
struct FoamStiffness {
    double period = 0;  ///< side of a sample, mm
    int elements = 0;   ///< along it
    std::vector<Homogenized> samples;

    double mean(double (*number)(const Homogenized&)) const;
    /// Of single samples about their mean: the standard deviation; 0 of a single one.
    double spread(double (*number)(const Homogenized&)) const;
    /// The mean of the samples' tensors.
    ElasticTensor stiffness() const;
};

double density_of(const Homogenized& sample);
/// Of the closest isotropic stiffness.
double young_of(const Homogenized& sample);
double poisson_of(const Homogenized& sample);
double shear_of(const Homogenized& sample);
double bulk_of(const Homogenized& sample);

/// Throws InputError where a number of the foam is a formula: a sample stands for one place.
void check_uniform(const FoamRecipe& foam);

/// One of the solves that a result consists of. None needs another: they can be done in any order, anywhere.
struct StiffnessSolve {
    double ratio = 0;    ///< of members to cells, for a point of the foam's law; 0: the recipe's foam
    int sample = 0;      ///< which, from 0
    double poisson = 0;  ///< of the material where it is for a law
    bool coarse = false;
    double work = 1;  ///< about, as a share of the result's
};

/// What came of one.
struct SolvedSample {
    double period = 0;  ///< side of the sample, mm
    int elements = 0;   ///< along it
    Homogenized found;
};

/// Homogenises a sample of the recipe's foam, one period; a random foam is made to repeat for it, each sample
/// with a seed of its own. Throws InputError where the foam varies in space or cannot repeat.
SolvedSample solve_sample(const Recipe& recipe, const StiffnessSolve& solve, StiffnessOptions options);

/// The solves for the stiffness of the recipe's foam, and what their results, in that order, say of it.
std::vector<StiffnessSolve> foam_solves(const Recipe& recipe, const StiffnessOptions& options);
FoamStiffness foam_stiffness(std::span<const SolvedSample> solved);

/// Throws InputError where a point of the foam's law cannot be computed: members that fill their cells.
void check_law_point(const Recipe& recipe, double ratio);

/// The solves for a point of the foam's law, its stiffness with cells so large that the members' ratio to
/// them is `ratio`, and what their results, in that order, say of it. The material is given by the law, not
/// by the options.
std::vector<StiffnessSolve> law_solves(const Recipe& recipe, double ratio, const StiffnessOptions& options);
FoamLawPoint law_point(double ratio, std::span<const SolvedSample> solved);

}  // namespace lamella
