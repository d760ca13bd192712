// Dilates flags of elements by a ball.
#include "recipe/structure/loaded_elements.h"

#include <algorithm>
#include <cmath>

#include "procedural/optimization/density_shape.h"

namespace lamella {

std::vector<std::uint8_t> elements_near(glm::ivec3 size, std::span<const std::uint8_t> flags, double radius) {
    std::vector<std::uint8_t> near(flags.size());
    const DensityGrid grid{size, {}, {}};
    const int reach = static_cast<int>(std::ceil(radius));
    for (std::size_t i = 0; i < flags.size(); ++i) {
        if (flags[i] == 0) continue;
        const glm::ivec3 middle = grid.element(i), lo = glm::max(middle - reach, glm::ivec3(0)),
                         hi = glm::min(middle + reach, size - 1);
        for (int z = lo.z; z <= hi.z; ++z) {
            for (int y = lo.y; y <= hi.y; ++y) {
                for (int x = lo.x; x <= hi.x; ++x) {
                    const dvec3 from(glm::ivec3(x, y, z) - middle);
                    if (glm::dot(from, from) <= radius * radius) near[grid.place({x, y, z})] = 1;
                }
            }
        }
    }
    return near;
}

template <std::size_t Dim>
void make_loads_solid(double radius, ElementDomain& domain, StructuralProblem<Dim>& problem) {
    const std::vector<std::uint8_t> near = elements_near(domain.size, problem.loaded, std::max(radius, 0.0));
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (near[i] != 0 && domain.use[i] == ElementUse::free)
            domain.use[i] = problem.topology.use[i] = ElementUse::solid;
    }
}

template void make_loads_solid(double, ElementDomain&, StructuralProblem<2>&);
template void make_loads_solid(double, ElementDomain&, StructuralProblem<3>&);

}  // namespace lamella
