// Homogenisation: the effective stiffness of a periodic structure.
#pragma once

#include <functional>

#include "engine/layers/layer_stream.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

struct HomogenizationOptions {
    double tolerance = 1e-7;  ///< relative residual: norm of the residual forces over that of the loads
    int max_iterations = 2000;
    int threads = 0;  ///< 0: one per core
    /// Called before each iteration with the relative residual; may be empty.
    std::function<void(int iteration, double left)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

struct Homogenized {
    ElasticTensor stiffness{};
    double density = 0;     ///< solid volume fraction
    int iterations = 0;     ///< of the conjugate gradient method, for the slowest load case
    std::size_t nodes = 0;  ///< nodes that touch solid elements
};

/// Computes the effective stiffness of a periodic sample of cubic elements, each solid or void. Solves finite
/// elements under six unit strains, with displacements periodic at the sample's sides, by conjugate gradients
/// preconditioned by a multigrid cycle (ElasticMultigrid). The error of the stiffness is quadratic in the
/// residual. A pure function of sample, material and tolerance. Throws InputError for an empty sample or an
/// invalid material, FaultError when max_iterations do not suffice, Interrupted when cancelled.
Homogenized homogenize(const ElementMask& sample, const IsotropicMaterial& material,
                       const HomogenizationOptions& options = {});

}  // namespace lamella
