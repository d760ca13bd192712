// Three gradings, made one unit vector.
#include "recipe/structure/element_ways.h"

namespace lamella {

dvec3 ElementWays::at(dvec3 p) const {
    const dvec3 way(parts_[0]->at(p), parts_[1]->at(p), is_flat_ ? 0 : parts_[2]->at(p));
    const double size = length(way);
    constexpr double least = 1e-12;
    return size > least && size < infinity ? way / size : dvec3(1, 0, 0);
}

std::optional<ElementWays> element_ways(const Recipe& recipe, Gradings& gradings) {
    const GradedTriple& along = recipe.elements->along;
    if (constant(along) == dvec3(0)) return std::nullopt;
    std::array<GradingPtr, 3> parts;
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = gradings.resolve(along[i]);
    return ElementWays(std::move(parts), recipe.elements->dimensions == 2);
}

}  // namespace lamella
