// The hot loops of elastic structures on grids: forces due to displacements, and elements' energies.
#pragma once

#include <array>
#include <cstddef>

#include "procedural/elasticity/node_grid.h"

namespace lamella {

/// Elements that differ by a factor, their modulus: node forces need no assembled stencils.
template <std::size_t Dim, typename Number>
struct ElementForces {
    static constexpr std::size_t unknowns = Dim << Dim;

    std::array<Number, unknowns * unknowns> stiffness{};  ///< of an element of modulus 1, row by row
    const Number* moduli = nullptr;                       ///< by element number; 0: void
    std::array<std::ptrdiff_t, (std::size_t{1} << Dim)> corners{};  ///< NodeGrid::corner_steps
};

/// Writes the forces at the nodes [begin, end), multiples of a tile; `forces` begin with those of node
/// `begin`.
template <std::size_t Dim, typename Number>
void multiply(const ElementForces<Dim, Number>& elements, const std::array<const Number*, Dim>& displacements,
              const std::array<Number*, Dim>& forces, std::size_t begin, std::size_t end);

/// Writes twice the strain energy that each element [begin, end) would have if its modulus were 1.
template <std::size_t Dim>
void element_energies(const ElementForces<Dim, double>& elements,
                      const std::array<const double*, Dim>& displacements, double* energies,
                      std::size_t begin, std::size_t end);

/// A stencil a node: by neighbour, then row, then column, for a tile of nodes at a time.
template <std::size_t Dim>
struct StencilForces {
    static constexpr std::size_t entries = NodeGrid<Dim>::neighbours * Dim * Dim;

    const float* stencils = nullptr;                                     ///< entries * tile numbers a tile
    std::array<std::ptrdiff_t, NodeGrid<Dim>::neighbours> neighbours{};  ///< NodeGrid::neighbour_steps
};

template <std::size_t Dim>
void multiply(const StencilForces<Dim>& stencils, const std::array<const float*, Dim>& displacements,
              const std::array<float*, Dim>& forces, std::size_t begin, std::size_t end);

}  // namespace lamella
