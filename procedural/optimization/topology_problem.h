// TopologyProblem: a body, its loads and what is asked of the material inside it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/elasticity/elastic_solver.h"
#include "procedural/optimization/density_map.h"
#include "procedural/optimization/modulus_law.h"

namespace lamella {

/// Loads that act together.
template <std::size_t Dim>
struct LoadCase {
    std::string name;
    double weight = 1;  ///< of its compliance in the sum over all cases
    NodalVector<Dim, double> forces;
};

/// Lengths in elements. With element edge h (mm) and the solid's modulus E (MPa), forces in N give
/// displacements in mm after division by E h in space, and by E times the thickness (mm) in the plane.
template <std::size_t Dim>
struct TopologyProblem {
    ElasticBody<Dim> body;                    ///< element of modulus 1; `present` is derived from `use`
    std::vector<ElementUse> use{};            ///< by element, x fastest, without the margin of NodeGrid
    std::vector<LoadCase<Dim>> cases{};       ///< one or more
    std::array<double, Dim> weight{};         ///< force of a solid element under gravity, in every case
    std::shared_ptr<const ModulusLaw> law{};  ///< of every element, unless there are `laws`
    std::vector<std::shared_ptr<const ModulusLaw>> laws{};  ///< of which `law_of` says one by element
    std::vector<std::uint32_t> law_of{};
    double volume = 0.5;  ///< most of the mean density over all elements that are not outside
    double least_density = 0, greatest_density = 1;  ///< of free elements, unless there are `limits`
    /// By element: of a free one the least density and the greatest, of a kept one its density twice.
    std::vector<Interval> limits{};

    const ModulusLaw& law_at(std::size_t element) const {
        return laws.empty() ? *law : *laws[law_of[element]];
    }
    Interval limits_at(std::size_t element) const {
        return limits.empty() ? Interval{least_density, greatest_density} : limits[element];
    }
};

/// Bounds of the design variables, by element.
struct DesignBounds {
    std::vector<double> lower, upper;
};

/// Returns the bounds of free elements, and the density of prescribed ones: the filter has to see solid
/// elements as solid, or what touches them could not become so.
template <std::size_t Dim>
DesignBounds design_bounds(const TopologyProblem<Dim>& problem) {
    DesignBounds bounds;
    for (std::size_t i = 0; i < problem.use.size(); ++i) {
        const ElementUse use = problem.use[i];
        const double full = use == ElementUse::solid ? 1 : 0;
        const bool is_limited = use == ElementUse::free || use == ElementUse::kept;
        const Interval limits = is_limited ? problem.limits_at(i) : Interval{full, full};
        bounds.lower.push_back(limits.lo);
        bounds.upper.push_back(limits.hi);
    }
    return bounds;
}

/// The grid numbers of the elements of a box, in the order of DesignGrid.
template <std::size_t Dim>
std::vector<std::size_t> element_numbers(const NodeGrid<Dim>& grid) {
    std::vector<std::size_t> numbers;
    const glm::ivec3 n = grid.elements();
    numbers.reserve(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                    static_cast<std::size_t>(n.z));
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) numbers.push_back(grid.number(x, y, z));
        }
    }
    return numbers;
}

}  // namespace lamella
