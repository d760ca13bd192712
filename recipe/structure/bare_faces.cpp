// The nearest point of the surface, by the gradient of the body's distance.
#include "recipe/structure/bare_faces.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "procedural/optimization/density_shape.h"
#include "procedural/skin/surface_walk.h"
#include "recipe/recipe.h"

namespace lamella {

bool has_bare_faces(const Recipe& recipe) {
    const auto is_covered_by = [](const SkinRecipe& skin) {
        return skin.thickness.is_formula() || skin.thickness.number() > 0;
    };
    return recipe.foam && !recipe.frame && !(recipe.skin && is_covered_by(*recipe.skin));
}

bool softens_at_faces(const Recipe& recipe) {
    return has_bare_faces(recipe) && recipe.foam->kind == "voronoi";
}

std::vector<Interval> depths_below_faces(const Field& body, const ElementDomain& domain,
                                         std::span<const std::uint8_t> held, double most) {
    const DensityGrid places{domain.size, {}, {}};
    const double edge = domain.shortest_edge();
    const auto is_covered = [&](dvec3 p) {
        const glm::ivec3 at(glm::floor((p - domain.box.lo) / domain.edges));
        const std::size_t i = places.place(glm::clamp(at, glm::ivec3(0), domain.size - 1));
        return domain.use[i] == ElementUse::solid || held[i] != 0;
    };
    std::vector<Interval> depths(domain.use.size(), Interval{infinity, infinity});
    parallel_for(depths.size(), [&](std::size_t i) {
        if (domain.use[i] != ElementUse::free && domain.use[i] != ElementUse::kept) return;
        const dvec3 centre = domain.centre(places.element(i));
        const double depth = std::max(0.0, -body.value(centre));
        if (depth > most && domain.dimensions == 3) return;
        // The middle plane of a plate is equally far from both faces, and has no gradient.
        const double step = std::min(edge, domain.edges.z) / 8;
        const dvec3 beside = domain.dimensions == 2 ? centre + dvec3(0, 0, 2 * step) : centre;
        const dvec3 out = rising(body, beside, step).value_or(dvec3(0));
        if (is_covered(centre + std::max(depth - edge / 2, 0.0) * out)) return;
        // Elements of a plate are as thick as it: from its middle plane to a face.
        constexpr double steep = 0.9;
        const bool is_across = domain.dimensions == 2 && std::abs(out.z) > steep;
        depths[i] =
            is_across ? Interval{0, depth} : Interval{std::max(depth - edge / 2, 0.0), depth + edge / 2};
        if (!is_across && depths[i].lo > most) depths[i] = {infinity, infinity};
    });
    return depths;
}

}  // namespace lamella
