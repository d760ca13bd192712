// From [[load]] and [[anchor]] to nodal forces and fixed nodes.
#pragma once

#include <string>

#include "procedural/optimization/topology_problem.h"
#include "recipe/base_material.h"
#include "recipe/structure/element_domain.h"

namespace lamella {

/// A part under its loads. The solid's modulus is 1 and elements have edge 1 along x: `displacement_unit`
/// turns displacements into mm, and, with forces in N, compliances into N mm.
template <std::size_t Dim>
struct StructuralProblem {
    TopologyProblem<Dim> topology;
    BaseMaterial material{};
    bool material_is_assumed = false;  ///< the recipe names no modulus: 1 MPa
    double displacement_unit = 1;
    std::vector<std::uint8_t> anchored{}, loaded{};  ///< by element: touches such a node
    std::vector<std::string> notes{};                ///< pieces of the body that were left out

    /// Flags the elements that an anchor or a load touches.
    std::vector<std::uint8_t> anchored_or_loaded() const {
        std::vector<std::uint8_t> flags = anchored;
        for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = flags[i] != 0 || loaded[i] != 0;
        return flags;
    }
};

/// Stands for the material's Poisson's ratio.
constexpr double material_poisson = -1;

/// Which elements hold material, by element; empty: all of the body may.
using FilledElements = std::vector<std::uint8_t>;

/// Makes loads and supports of the elements' nodes; pieces of the body that are neither held nor loaded
/// become outside. A node lies in a place if it is within half an element of it. Forces are spread over nodes
/// by the number of their elements, as a uniform traction or body force is; by that of their `filled`
/// elements where a load has some, since it acts on the material that is there; pressure acts on all of the
/// body's surface in its place. `element_poisson` is that of
/// the elements, or material_poisson. Throws InputError for places without nodes, loaded pieces that are not
/// held, and pieces that can still move or turn.
template <std::size_t Dim>
StructuralProblem<Dim> structural_problem(const Recipe& recipe, ElementDomain& domain, Gradings& gradings,
                                          double element_poisson, const FilledElements& filled = {});

}  // namespace lamella
