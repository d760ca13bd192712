// What the searches for a shape and for an appearance take from [optimize].
#pragma once

#include "procedural/optimization/density_map.h"
#include "recipe/base_material.h"
#include "recipe/structure/element_domain.h"

namespace lamella {

/// Modulus of void, as a share of the solid's.
template <std::size_t Dim>
constexpr double void_modulus_of = Dim == 2 ? 1e-9 : 1e-6;
/// Density below which the modulus falls linearly under self-weight (Pedersen 2000): of thin material there
/// is weight, but by the power law no stiffness.
constexpr double linear_below = 0.1;

/// Filter, least sizes, symmetry and overhang, in elements.
DensitySettings density_settings(const OptimizeRecipe& optimize, const ElementDomain& domain);

/// Returns the share of the body that material may fill. Throws InputError for a mass that the whole body
/// does not have.
double volume_bound(const OptimizeRecipe& optimize, const ElementDomain& domain,
                    const BaseMaterial& material);

}  // namespace lamella
