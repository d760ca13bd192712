// Samples the body and its regions at the centres of elements.
#include "recipe/structure/element_domain.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elasticity/field_sample.h"

namespace lamella {

namespace {

constexpr int default_elements_3d = 64, default_elements_2d = 200;
// Solver, filters and update of one load case, measured; further cases add three numbers a node.
constexpr double bytes_an_element = 700, bytes_a_case = 24;
constexpr int most_along = 2048;

/// Returns the edge of an element, mm.
double edge_of(const OptimizeRecipe& optimize, dvec3 size) {
    if (optimize.element > 0) return optimize.element;
    const double longest =
        optimize.dimensions == 2 ? std::max(size.x, size.y) : std::max({size.x, size.y, size.z});
    const int standard = optimize.dimensions == 2 ? default_elements_2d : default_elements_3d;
    return longest / (optimize.elements > 0 ? optimize.elements : standard);
}

/// Returns the section that asks for finite elements.
std::string section_of(const Recipe& recipe) { return recipe.elements ? "elements" : "optimize"; }

void check_size(const Recipe& recipe, glm::ivec3 size, double edge) {
    const std::string section = section_of(recipe);
    const std::size_t cases = std::max<std::size_t>(recipe.loads.size(), 1);
    for (int k = 0; k < 3; ++k) {
        if (size[k] <= most_along) continue;
        throw InputError(
            fmt::format("{0}.element / --{0}-element: {1:.4g} mm cuts the part into {2} finite elements "
                        "along a side; accepted: at most {3}",
                        section, edge, size[k], most_along));
    }
    const double elements = static_cast<double>(size.x) * size.y * size.z;
    const double needed = elements * (bytes_an_element + bytes_a_case * static_cast<double>(cases));
    const double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed <= memory || memory <= 0) return;
    const double suited = edge * std::pow(needed / memory, 1.0 / (size.z == 1 ? 2 : 3));
    throw InputError(
        fmt::format("{0}: {1:.3g} million elements of {2:.4g} mm need about {3:.3g} GB of memory, "
                    "and this machine has {4:.3g} GB; accepted: {0}.element of {5:.2g} mm or more",
                    section, elements / 1e6, edge, needed / 1e9, memory / 1e9, suited));
}

/// Turns elements that are kept from free ones into another use.
void prescribe(ElementDomain& domain, const std::vector<std::uint8_t>& inside, ElementUse use) {
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (inside[i] != 0 && domain.use[i] != ElementUse::outside) domain.use[i] = use;
    }
}

/// Makes the elements under a skin of constant thickness solid: those whose centres are less deep.
void prescribe_skin(const Recipe& recipe, const Field& body, ElementDomain& domain) {
    if (!recipe.skin || recipe.skin->thickness.is_formula() || recipe.skin->side == SkinSide::outside) return;
    const double thickness = recipe.skin->thickness.number();
    parallel_for(domain.size.y * domain.size.z, [&](int row) {
        for (int x = 0; x < domain.size.x; ++x) {
            const glm::ivec3 at(x, row % domain.size.y, row / domain.size.y);
            const std::size_t place = static_cast<std::size_t>(x) +
                                      static_cast<std::size_t>(domain.size.x) * static_cast<std::size_t>(row);
            if (domain.use[place] != ElementUse::free) continue;
            if (body.value(domain.centre(at)) > -thickness) domain.use[place] = ElementUse::solid;
        }
    });
}

/// Returns the box of a grid with this middle.
Box around(dvec3 middle, dvec3 edges, glm::ivec3 size) {
    const dvec3 half = 0.5 * edges * dvec3(size);
    return {middle - half, middle + half};
}

/// Says which elements of the grid belong to the body, and which of them are prescribed.
void classify(const Recipe& recipe, const Field& body, const BuiltRegions& regions, const CancelToken* cancel,
              ElementDomain& domain) {
    for (const std::uint8_t inside : elements_inside(body, domain, cancel))
        domain.use.push_back(inside != 0 ? ElementUse::free : ElementUse::outside);
    if (domain.elements() == 0)
        throw InputError(
            fmt::format("{0}: no element of {1:.4g} mm has its centre in the part; accepted: smaller "
                        "elements, by {0}.element",
                        section_of(recipe), domain.longest_edge()));
    prescribe_skin(recipe, body, domain);
    for (const BuiltRegion& region : regions.list) {
        if (region.make != RegionMake::solid && region.make != RegionMake::empty) continue;
        prescribe(domain, elements_inside(*region.field, domain, cancel),
                  region.make == RegionMake::solid ? ElementUse::solid : ElementUse::empty);
    }
}

}  // namespace

std::size_t ElementDomain::elements() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(use, [](ElementUse u) { return u != ElementUse::outside; }));
}

double ElementDomain::shortest_edge() const {
    const double least = std::min(edges.x, edges.y);
    return dimensions == 2 ? least : std::min(least, edges.z);
}

double ElementDomain::longest_edge() const {
    const double most = std::max(edges.x, edges.y);
    return dimensions == 2 ? most : std::max(most, edges.z);
}

dvec3 ElementDomain::node(glm::ivec3 at) const {
    const dvec3 p = box.lo + dvec3(at) * edges;
    return dimensions == 2 ? dvec3(p.x, p.y, 0.5 * (box.lo.z + box.hi.z)) : p;
}

std::vector<std::uint8_t> elements_inside(const Field& field, const ElementDomain& domain,
                                          const CancelToken* cancel) {
    return sample_field(field, domain.box, domain.size, cancel).present;
}

ElementDomain element_domain(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                             const CancelToken* cancel) {
    const OptimizeRecipe optimize = recipe.optimize.value_or(OptimizeRecipe());
    const Box bounds = body.bounds();
    ElementDomain domain;
    domain.dimensions = optimize.dimensions;
    const double edge = edge_of(optimize, bounds.size());
    const auto along = [&](int axis) {
        return std::max(1, static_cast<int>(std::round(std::min(bounds.size()[axis] / edge, 1e9))));
    };
    domain.size = {along(0), along(1), optimize.dimensions == 2 ? 1 : along(2)};
    check_size(recipe, domain.size, edge);
    domain.edges = dvec3(edge);
    for (int axis = 0; axis < optimize.dimensions && !optimize.overhang; ++axis) {
        const double fitting = bounds.size()[axis] / domain.size[axis];
        constexpr double rounding = 1e-9;  // cubes that fit stay cubes
        if (std::abs(fitting - edge) > rounding * edge) domain.edges[axis] = fitting;
    }
    if (domain.dimensions == 2) domain.edges.z = bounds.size().z;
    domain.box = around(0.5 * (bounds.lo + bounds.hi), domain.edges, domain.size);
    classify(recipe, body, regions, cancel, domain);
    return domain;
}

ElementDomain element_domain_of(const Recipe& recipe, const Field& body, const BuiltRegions& regions,
                                const ElementDomain& domain, glm::ivec3 size, double ratio,
                                const CancelToken* cancel) {
    ElementDomain other{
        .dimensions = domain.dimensions, .size = size, .edges = ratio * domain.edges, .box = {}, .use = {}};
    if (domain.dimensions == 2) other.edges.z = domain.edges.z;
    other.box = around(0.5 * (domain.box.lo + domain.box.hi), other.edges, size);
    classify(recipe, body, regions, cancel, other);
    return other;
}

}  // namespace lamella
