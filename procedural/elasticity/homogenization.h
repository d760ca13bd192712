// Homogenisation: the stiffness of a structure that repeats, as a block of it would show it.
#pragma once

#include <functional>

#include "engine/layers/layer_stream.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

struct HomogenizationOptions {
    double tolerance = 1e-7;  ///< of the forces that are left, as a share of the loads
    int max_iterations = 2000;
    int threads = 0;  ///< 0: one per core
    /// Told after each iteration, with the forces left over the loads; may be empty.
    std::function<void(int iteration, double left)> on_progress{};
    const CancelToken* cancel = nullptr;  ///< may be null
};

struct Homogenized {
    ElasticTensor stiffness{};
    double density = 0;     ///< share of solid elements
    int iterations = 0;     ///< of conjugate gradients, for the slowest load case
    std::size_t nodes = 0;  ///< that elements touch
};

/// The effective stiffness of a periodic sample of cubic elements, solid or void: finite elements under six
/// strains with displacements periodic at the sample's sides, solved by conjugate gradients on a multigrid
/// cycle (ElasticMultigrid). What the forces left make wrong comes in with their square. A pure function of
/// sample, material and tolerance. Throws InputError for an empty sample or what is no material, FaultError
/// where the iterations do not suffice, Interrupted when cancelled.
Homogenized homogenize(const ElementMask& sample, const IsotropicMaterial& material,
                       const HomogenizationOptions& options = {});

}  // namespace lamella
