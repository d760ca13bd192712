// Lengths in mm become lengths in elements, a mass becomes a volume.
#include "recipe/structure/design_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"

namespace lamella {

namespace {

constexpr double least_radius = 1.5;  // elements; below, checkerboards

}  // namespace

DensitySettings density_settings(const OptimizeRecipe& optimize, const ElementDomain& domain) {
    DensitySettings settings;
    settings.radius = std::max(least_radius, optimize.radius / domain.shortest_edge());
    if (optimize.member > 0 || optimize.gap > 0) {
        settings.length_scale = length_scale_for({.member = optimize.member,
                                                  .gap = optimize.gap,
                                                  .element = domain.shortest_edge(),
                                                  .dimensions = domain.dimensions});
    }
    for (const char axis : optimize.symmetry) settings.mirrored[static_cast<std::size_t>(axis - 'x')] = true;
    if (optimize.overhang) settings.overhang.emplace();
    return settings;
}

double volume_bound(const OptimizeRecipe& optimize, const ElementDomain& domain,
                    const BaseMaterial& material) {
    if (optimize.mass == 0) return optimize.volume;
    const double full =
        1e-3 * material.density * domain.element_volume() * static_cast<double>(domain.elements());
    if (optimize.mass >= full)
        throw InputError(
            fmt::format("optimize.mass / --optimize-mass: {} g is no less than the whole part's {:.4g} g; "
                        "accepted: less",
                        optimize.mass, full));
    return optimize.mass / full;
}

}  // namespace lamella
