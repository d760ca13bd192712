// How stiff the foam of a recipe is: samples of it that repeat, homogenised.
#pragma once

#include <functional>
#include <vector>

#include "procedural/foam_law.h"
#include "procedural/homogenization.h"
#include "recipe/recipe.h"

namespace lamella {

struct StiffnessOptions {
    int elements = 0;  ///< along a sample's side; 0: four along the radius of the thinnest member, 32 to 320
                       ///< and about a million of them solid at most
    int samples = 1;   ///< of a random foam, each of 64 cells or more; of foams without chance one is made
    IsotropicMaterial material{};
    double tolerance = 1e-6;  ///< as HomogenizationOptions
    int threads = 0;          ///< 0: one per core
    /// Told how much of all the work is done, 0 to 1; may be empty.
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

/// Homogenises samples of the recipe's foam, one period each; a random foam is made to repeat for it, each
/// sample with a seed of its own. Throws InputError where the foam varies in space or cannot repeat.
FoamStiffness foam_stiffness(const Recipe& recipe, const StiffnessOptions& options);

/// Throws InputError where a point of the foam's law cannot be computed: members that fill their cells.
void check_law_point(const Recipe& recipe, double ratio);

/// A point of the foam's law: its stiffness with cells so large that the members' ratio to them is `ratio`.
/// The material is given by the law, not by the options.
FoamLawPoint law_point(const Recipe& recipe, double ratio, StiffnessOptions options);

}  // namespace lamella
