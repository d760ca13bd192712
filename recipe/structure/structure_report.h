// StructureReport: how a part bears its loads, from one finite element analysis.
#pragma once

#include <string>
#include <vector>

#include "procedural/optimization/topology_optimizer.h"
#include "recipe/structure/structural_problem.h"

namespace lamella {

/// Displacements and stresses under one load case.
struct CaseReport {
    std::string name;
    double weight = 1;
    double compliance = 0;            ///< N mm
    double largest_displacement = 0;  ///< mm
    dvec3 displacement_at{0};         ///< mm
    double peak_stress = 0;           ///< von Mises at the centre of a solid element, MPa
    dvec3 stress_at{0};               ///< mm
};

/// A node on which a load acts, in the load's direction.
struct NodeForce {
    dvec3 at{0};     ///< mm
    dvec3 force{0};  ///< N
};

/// A step of a search.
struct OptimizationStep : TopologyIteration {
    double appearance = 0;  ///< A of the densities, see Appearance; 0: no picture was given
};

/// What an optimisation or analysis found.
struct StructureReport {
    int dimensions = 3;
    glm::ivec3 size{0};        ///< of the grid, elements
    std::size_t elements = 0;  ///< of the body
    dvec3 element{0};          ///< edges, mm
    double young = 0;          ///< of the solid, MPa
    double poisson = 0;
    bool material_is_assumed = false;
    double body_volume = 0;           ///< of the body's elements, mm^3
    double volume_bound = 1;          ///< share of it
    double compliance_bound = 0;      ///< as a multiple of full_compliance; 0: none
    double full_compliance = 0;       ///< with material everywhere, N mm; weighted sum over the cases
    double densities_compliance = 0;  ///< of the densities at the end, N mm; 0: nothing was optimised
    double compliance = 0;            ///< of the shape (or of the foam), N mm
    double volume = 0;    ///< share of the body's volume that the shape fills, or the foam's mean density
    double mass = 0;      ///< g; 0: the material's density is unknown
    double greyness = 0;  ///< of the densities at the end
    std::size_t stray_pieces = 0;  ///< dropped
    bool is_converged = false;     ///< by the tolerance, within the iterations
    /// With a picture: A of the densities at the end and of the stiffest ones; 0: none was given.
    double appearance = 0, stiffest_appearance = 0;
    double least_compliance = 0;            ///< with a picture: of the stiffest densities, N mm
    std::vector<OptimizationStep> history;  ///< compliances in N mm; with a picture as multiples of the least
    std::vector<CaseReport> cases;
    std::vector<NodeForce> loaded;  ///< nodes with forces, of all cases; without self-weight
    std::vector<dvec3> held;        ///< nodes that are held along one axis or more, mm
    std::vector<std::string> notes;
};

/// Describes the problem: sizes, material, loads, supports, notes.
template <std::size_t Dim>
void describe(const StructuralProblem<Dim>& problem, const ElementDomain& domain, StructureReport& report);

/// Adds a note if foam has neither skin nor frame, and its law does not know how little its cut cells carry.
void note_bare_foam(const Recipe& recipe, StructureReport& report);

/// Returns the densities of the body with material everywhere.
std::vector<double> full_densities(std::span<const ElementUse> use);

/// Analyses the body with material everywhere, unless the report has its full_compliance, and with these
/// densities under a law, and adds compliance, volume, mass and the cases. Stresses are of elements that are
/// at least half solid; none of a foam, whose struts the elements do not show.
template <std::size_t Dim>
void analyse(const StructuralProblem<Dim>& problem, const ElementDomain& domain,
             const std::shared_ptr<const ModulusLaw>& law, std::span<const double> density, bool is_foam,
             const CancelToken* cancel, StructureReport& report);

}  // namespace lamella
