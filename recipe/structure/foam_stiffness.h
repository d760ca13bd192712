// Homogenisation of a recipe's foam by periodic samples.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "procedural/elasticity/foam_law.h"
#include "procedural/elasticity/homogenization.h"
#include "recipe/recipe.h"

namespace lamella {

struct StiffnessOptions {
    int elements = 0;  ///< along a sample's side; 0: four along the radius of the thinnest member, clamped to
                       ///< 32 to 320 and to about a million solid elements
    int samples = 1;   ///< number of samples of a random foam, each of 64 cells or more; deterministic foams
                       ///< have one
    IsotropicMaterial material{};
    double tolerance = 1e-6;  ///< as in HomogenizationOptions
    int threads = 0;          ///< 0: one per core
    /// Receives the finished share of a solve, 0 to 1; may be empty.
    std::function<void(double share)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Results of all samples.
struct FoamStiffness {
    double period = 0;  ///< side of a sample, mm
    int elements = 0;   ///< along it
    std::vector<Homogenized> samples;

    double mean(double (*number)(const Homogenized&)) const;
    /// Returns the standard deviation of the samples about their mean; 0 for a single sample.
    double spread(double (*number)(const Homogenized&)) const;
    /// Returns the mean of the samples' tensors.
    ElasticTensor stiffness() const;
};

double density_of(const Homogenized& sample);
/// These four belong to the isotropic stiffness closest to the sample's.
double young_of(const Homogenized& sample);
double poisson_of(const Homogenized& sample);
double shear_of(const Homogenized& sample);
double bulk_of(const Homogenized& sample);

/// Throws InputError when a number of the foam is a formula: a sample represents one place.
void check_uniform(const FoamRecipe& foam);

/// One of the solves that make up a result. They are independent: any order and any process will do.
struct StiffnessSolve {
    double ratio = 0;    ///< ratio of members to cells, for a point of the foam's law; 0: the recipe's foam
    int sample = 0;      ///< index of the sample
    double poisson = 0;  ///< of the material, when the solve is for a law
    bool coarse = false;
    double work = 1;  ///< estimated share of the result's total work
};

/// The result of a solve.
struct SolvedSample {
    double period = 0;  ///< side of the sample, mm
    int elements = 0;   ///< along it
    Homogenized found;
};

/// Homogenises one period of the recipe's foam. A random foam is made periodic for it, each sample with its
/// own seed. Throws InputError when the foam varies in space or cannot be periodic.
SolvedSample solve_sample(const Recipe& recipe, const StiffnessSolve& solve, StiffnessOptions options);

/// Return the solves for the stiffness of the recipe's foam, and the stiffness from their results, in that
/// order.
std::vector<StiffnessSolve> foam_solves(const Recipe& recipe, const StiffnessOptions& options);
FoamStiffness foam_stiffness(std::span<const SolvedSample> solved);

/// Throws InputError when a point of the foam's law cannot be computed because members fill their cells.
void check_law_point(const Recipe& recipe, double ratio);

/// Return the solves for a point of the foam's law (cells so large that the ratio of members to cells is
/// `ratio`), and the point from their results, in that order. The law prescribes the material; that of the
/// options is ignored.
std::vector<StiffnessSolve> law_solves(const Recipe& recipe, double ratio, const StiffnessOptions& options);
FoamLawPoint law_point(double ratio, std::span<const SolvedSample> solved);

}  // namespace lamella
