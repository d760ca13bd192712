// Coarse stencils: the stiffness of a grid of twice the element size under multilinear displacements.
#pragma once

#include <span>

#include "procedural/elasticity/elastic_body.h"
#include "procedural/elasticity/grid_stiffness.h"

namespace lamella {

/// The grid whose elements are twice as large. Where a side is odd, the last elements reach beyond the body.
template <std::size_t Dim>
NodeGrid<Dim> coarser(const NodeGrid<Dim>& fine) {
    return NodeGrid<Dim>((fine.elements() + 1) / 2);
}

/// Returns the elements of the coarser grid that have a child in `present`.
template <std::size_t Dim>
std::vector<std::uint8_t> coarse_elements(const NodeGrid<Dim>& fine,
                                          const std::vector<std::uint8_t>& present);

/// Stencils of the nodes of a grid, laid out as StencilForces says.
template <std::size_t Dim>
struct Stencils {
    NodeGrid<Dim> grid;
    std::vector<float> numbers;

    explicit Stencils(const NodeGrid<Dim>& nodes)
        : grid(nodes), numbers(grid.size() * StencilForces<Dim>::entries) {}
    float& at(std::size_t node, std::size_t entry) {
        constexpr std::size_t tile = NodeGrid<Dim>::tile;
        return numbers[(node / tile * StencilForces<Dim>::entries + entry) * tile + node % tile];
    }
    const float& at(std::size_t node, std::size_t entry) const {
        return const_cast<Stencils*>(this)->at(node, entry);
    }
};

/// Coarsens a body whose elements have these moduli: P^T K P, P being the multilinear interpolation that does
/// not move what is fixed. `runs` are the used nodes of the coarse grid.
template <std::size_t Dim>
void coarsen(const ElasticBody<Dim>& body, std::span<const float> moduli, const NodeRuns& runs,
             Stencils<Dim>& coarse);
/// Coarsens stencils.
template <std::size_t Dim>
void coarsen(const Stencils<Dim>& fine, Stencils<Dim>& coarse);

}  // namespace lamella
