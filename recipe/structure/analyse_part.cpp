// Densities that stand for the part, and one analysis.
#include "recipe/structure/analyse_part.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elasticity/cut_cells.h"
#include "procedural/optimization/density_shape.h"
#include "recipe/placement/part_placement.h"
#include "recipe/structure/bare_faces.h"

namespace lamella {

namespace {

constexpr double void_modulus = 1e-9;

bool has_law(const BuiltJob& built) { return built.foam && built.foam->modulus && built.foam->modulus->made; }

/// Sets the body's elements outside the part to outside: they carry nothing.
void keep_part(const Field& part, const CancelToken* cancel, ElementDomain& domain) {
    const std::vector<std::uint8_t> inside = elements_inside(part, domain, cancel);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (domain.use[i] == ElementUse::empty) domain.use[i] = ElementUse::outside;
        if (inside[i] == 0) domain.use[i] = ElementUse::outside;
    }
    if (domain.elements() == 0)
        throw InputError("analyze: no element has its centre in the part; accepted: more --elements");
}

/// Returns the relative modulus of each element, by the foam's law; 1 where it is solid.
std::vector<double> moduli_by_law(const ElementDomain& domain, const BuiltFoam& foam, double young) {
    std::vector<double> relative(domain.use.size(), 1.0);
    const DensityGrid places{domain.size, {}, {}};
    parallel_for(relative.size(), [&](std::size_t i) {
        if (domain.use[i] != ElementUse::free) return;
        relative[i] = foam.modulus->made->at(domain.centre(places.element(i))) / young;
    });
    return relative;
}

/// Makes the foam below bare faces as soft as its cut cells are.
void soften_faces(const Field& body, const ElementDomain& domain, const BuiltFoam& foam,
                  std::span<const std::uint8_t> held, std::vector<double>& relative) {
    const DensityGrid places{domain.size, {}, {}};
    const std::vector<Interval> depths =
        depths_below_faces(body, domain, held, cut_cells_depth(foam.cell.limits.hi));
    parallel_for(relative.size(), [&](std::size_t i) {
        if (depths[i].lo == infinity) return;
        const dvec3 centre = domain.centre(places.element(i));
        const double cell = foam.cell.made->at(centre);
        relative[i] *= cut_cells_share(depths[i], cell, foam.member.made->at(centre) / cell);
    });
}

template <std::size_t Dim>
StructureReport analysed(const Recipe& recipe, const BuiltJob& built, ElementDomain domain, bool by_law,
                         Gradings& gradings, const CancelToken* cancel) {
    const StructuralProblem<Dim> problem =
        structural_problem<Dim>(recipe, domain, gradings, material_poisson);
    StructureReport report;
    describe(problem, domain, report);
    report.volume_bound = 1;
    std::vector<double> density(domain.use.size(), 1.0);
    if (by_law) {
        density = moduli_by_law(domain, *built.foam, problem.material.elastic.young);
        if (softens_at_faces(recipe))
            soften_faces(*built.body, domain, *built.foam, problem.anchored_or_loaded(), density);
    }
    analyse(problem, domain, make_penalty_law({1, void_modulus, 0}), density, by_law, cancel, report);
    if (by_law) {
        report.volume = report.mass = 0;  // what was summed were moduli
        note_bare_foam(recipe, report);
    }
    return report;
}

}  // namespace

StructureReport analyse_part(const Recipe& given, const BuiltJob& built, const AnalysisOptions& options) {
    Recipe recipe = with_known_placement(given);
    if (options.elements > 0) {
        if (!recipe.optimize) recipe.optimize.emplace();  // the part is built: this says the elements only
        recipe.optimize->elements = options.elements;
        recipe.optimize->element = 0;
    }
    const bool is_heavy = recipe.optimize && recipe.optimize->gravity != dvec3(0);
    if ((recipe.loads.empty() && !is_heavy) || recipe.anchors.empty())
        throw InputError(
            "analyze: the part is not both loaded and held; accepted: a [[load]] and an [[anchor]]");
    const bool by_law =
        options.model == AnalysisModel::law || (options.model == AnalysisModel::automatic && has_law(built));
    if (by_law && !has_law(built))
        throw InputError("--model law: the part has no foam whose law is known; accepted: elements");
    ThreadArena arena(options.threads);
    return arena.execute([&] {
        Gradings gradings(recipe);
        gradings.set_body(built.body);
        ElementDomain domain = element_domain(recipe, *built.body, built.regions, options.cancel);
        if (!by_law) keep_part(*built.designed.part, options.cancel, domain);
        return domain.dimensions == 2
                   ? analysed<2>(recipe, built, std::move(domain), by_law, gradings, options.cancel)
                   : analysed<3>(recipe, built, std::move(domain), by_law, gradings, options.cancel);
    });
}

}  // namespace lamella
