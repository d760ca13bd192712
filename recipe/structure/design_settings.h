// What the searches for a shape and for an appearance take from [optimize].
#pragma once

#include <memory>

#include "procedural/optimization/density_map.h"
#include "procedural/optimization/modulus_law.h"
#include "recipe/base_material.h"
#include "recipe/structure/element_domain.h"

namespace lamella {

/// Modulus of void, as a share of the solid's.
template <std::size_t Dim>
constexpr double void_modulus_of = Dim == 2 ? 1e-9 : 1e-6;
/// Returns the law of densities that are material or void: the power optimize.penalty, under self-weight
/// linear below a density of 0.1 (Pedersen 2000), where the power law leaves weight but no stiffness.
template <std::size_t Dim>
std::shared_ptr<const ModulusLaw> penalty_law(const OptimizeRecipe& optimize) {
    const bool is_heavy = optimize.gravity != dvec3(0);
    return make_penalty_law({optimize.penalty, void_modulus_of<Dim>, is_heavy ? 0.1 : 0.0});
}

/// Filter, least sizes, symmetry and overhang, in elements.
DensitySettings density_settings(const OptimizeRecipe& optimize, const ElementDomain& domain);

/// Returns the share of the body that material may fill. Throws InputError for a mass that the whole body
/// does not have.
double volume_bound(const OptimizeRecipe& optimize, const ElementDomain& domain,
                    const BaseMaterial& material);

}  // namespace lamella
