// Two solves, and the extremes of displacement and stress.
#include "recipe/structure/structure_report.h"

#include <cmath>

#include "procedural/optimization/density_shape.h"
#include "procedural/optimization/element_stress.h"
#include "recipe/structure/bare_faces.h"

namespace lamella {

namespace {

template <std::size_t Dim>
CaseReport case_report(const StructuralProblem<Dim>& problem, const ElementDomain& domain,
                       const NodalVector<Dim, double>& u, std::span<const double> density, bool is_foam) {
    const NodeGrid<Dim>& nodes = problem.topology.body.grid;
    const std::vector<std::size_t> numbers = element_numbers(nodes);
    ElasticBody<Dim> body = problem.topology.body;
    for (std::size_t e = 0; e < numbers.size(); ++e)
        body.present[numbers[e]] = problem.topology.use[e] != ElementUse::outside;
    const std::vector<double> stress = von_mises(body, problem.material.elastic.poisson, u);
    // Displacements of elements of edge 1 along x times the unit are mm; strains are those over that edge.
    const double stress_unit = problem.material.elastic.young * problem.displacement_unit / domain.edges.x;
    const DensityGrid places{domain.size, {}, {}};
    CaseReport result;
    for (std::size_t e = 0; e < density.size(); ++e) {
        constexpr double solid = 0.5;
        const bool is_there = is_foam ? density[e] > 0 : density[e] >= solid;
        if (domain.use[e] == ElementUse::outside || !is_there) continue;
        const glm::ivec3 element = places.element(e);
        const double peak = stress_unit * stress[numbers[e]];
        if (!is_foam && peak > result.peak_stress) {
            result.peak_stress = peak;
            result.stress_at = domain.centre(element);
        }
        for (int c = 0; c < 1 << Dim; ++c) {
            const glm::ivec3 corner = element + glm::ivec3(c & 1, c >> 1 & 1, c >> 2 & 1);
            const std::size_t node = nodes.number(corner.x, corner.y, corner.z);
            double square = 0;
            for (std::size_t d = 0; d < Dim; ++d) square += u.along[d][node] * u.along[d][node];
            const double moved = std::sqrt(square) * problem.displacement_unit;
            if (moved <= result.largest_displacement) continue;
            result.largest_displacement = moved;
            result.displacement_at = domain.node(corner);
        }
    }
    return result;
}

template <std::size_t Dim>
void add_nodes(const StructuralProblem<Dim>& problem, const ElementDomain& domain, StructureReport& report) {
    const ElasticBody<Dim>& body = problem.topology.body;
    const glm::ivec3 last = Dim == 2 ? glm::ivec3(domain.size.x, domain.size.y, 0) : domain.size;
    for (int z = 0; z <= last.z; ++z) {
        for (int y = 0; y <= last.y; ++y) {
            for (int x = 0; x <= last.x; ++x) {
                const std::size_t node = body.grid.number(x, y, z);
                if (body.fixed[node] != 0) report.held.push_back(domain.node({x, y, z}));
                for (const LoadCase<Dim>& load : problem.topology.cases) {
                    dvec3 force(0);
                    for (std::size_t d = 0; d < Dim; ++d)
                        force[static_cast<int>(d)] = load.forces.along[d][node];
                    if (force != dvec3(0)) report.loaded.push_back({domain.node({x, y, z}), force});
                }
            }
        }
    }
}

}  // namespace

template <std::size_t Dim>
void describe(const StructuralProblem<Dim>& problem, const ElementDomain& domain, StructureReport& report) {
    report.dimensions = static_cast<int>(Dim);
    report.size = domain.size;
    report.elements = domain.elements();
    report.element = domain.edges;
    report.young = problem.material.elastic.young;
    report.poisson = problem.material.elastic.poisson;
    report.material_is_assumed = problem.material_is_assumed;
    report.body_volume = domain.element_volume() * static_cast<double>(report.elements);
    report.volume_bound = problem.topology.volume;
    report.notes = problem.notes;
    add_nodes(problem, domain, report);
}

void note_bare_foam(const Recipe& recipe, StructureReport& report) {
    if (!has_bare_faces(recipe) || softens_at_faces(recipe)) return;
    // Measured on coupons of 8 x 4 x 4 cells with solid ends, in tension and bending.
    report.notes.emplace_back(
        "the foam is bare, and its law does not know how much softer it is where faces cut its cells: 4 "
        "cells "
        "across, kelvin and closed foams are up to a quarter softer, k-nearest ones two to four times; "
        "`lamella analyze --model elements` computes it, and a skin or a frame prevents it");
}

std::vector<double> full_densities(std::span<const ElementUse> use) {
    std::vector<double> full;
    full.reserve(use.size());
    for (const ElementUse u : use) full.push_back(u == ElementUse::outside || u == ElementUse::empty ? 0 : 1);
    return full;
}

template <std::size_t Dim>
void analyse(const StructuralProblem<Dim>& problem, const ElementDomain& domain,
             const std::shared_ptr<const ModulusLaw>& law, std::span<const double> density, bool is_foam,
             const CancelToken* cancel, StructureReport& report) {
    TopologyProblem<Dim> topology = problem.topology;
    topology.law = law;
    const std::vector<double> full = full_densities(topology.use);
    std::vector<double> shape(density.begin(), density.end());
    double sum = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
        const ElementUse use = topology.use[i];
        const bool is_given = use == ElementUse::free || use == ElementUse::kept;
        if (!is_given) shape[i] = use == ElementUse::solid ? 1 : 0;
        sum += shape[i];
    }
    Compliance<Dim> compliance(topology, {.tolerance = 1e-6, .cancel = cancel});
    typename Compliance<Dim>::Result found;
    if (report.full_compliance == 0 || shape == full) {
        found = compliance.evaluate(full);
        report.full_compliance = problem.displacement_unit * found.total;
    }
    if (shape != full) found = compliance.evaluate(shape);
    report.compliance = problem.displacement_unit * found.total;
    report.volume = sum / static_cast<double>(report.elements);
    report.mass = 1e-3 * problem.material.density * report.volume * report.body_volume;
    for (std::size_t c = 0; c < topology.cases.size(); ++c) {
        CaseReport& added = report.cases.emplace_back(
            case_report(problem, domain, compliance.displacements(c), shape, is_foam));
        added.name = topology.cases[c].name;
        added.weight = topology.cases[c].weight;
        added.compliance = problem.displacement_unit * found.by_case[c];
    }
}

template void describe(const StructuralProblem<2>&, const ElementDomain&, StructureReport&);
template void describe(const StructuralProblem<3>&, const ElementDomain&, StructureReport&);
template void analyse(const StructuralProblem<2>&, const ElementDomain&,
                      const std::shared_ptr<const ModulusLaw>&, std::span<const double>, bool,
                      const CancelToken*, StructureReport&);
template void analyse(const StructuralProblem<3>&, const ElementDomain&,
                      const std::shared_ptr<const ModulusLaw>&, std::span<const double>, bool,
                      const CancelToken*, StructureReport&);

}  // namespace lamella
