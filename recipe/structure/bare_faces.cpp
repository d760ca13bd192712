// The nearest point of the surface, by the gradient of the body's distance.
#include "recipe/structure/bare_faces.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "procedural/optimization/density_shape.h"
#include "recipe/recipe.h"

namespace lamella {

namespace {

/// Returns the outward direction of the nearest face.
dvec3 outwards(const Field& body, dvec3 p, double step) {
    dvec3 slope(0);
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 ahead = p, behind = p;
        ahead[axis] += step;
        behind[axis] -= step;
        slope[axis] = body.value(ahead) - body.value(behind);
    }
    const double length = glm::length(slope);
    return length > 0 ? slope / length : slope;
}

}  // namespace

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
        if (depth > most) return;
        const dvec3 out = outwards(body, centre, edge / 4);
        if (is_covered(centre + std::max(depth - edge / 2, 0.0) * out)) return;
        depths[i] = {depth - edge / 2, depth + edge / 2};
    });
    return depths;
}

}  // namespace lamella
