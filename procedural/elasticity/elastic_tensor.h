// Linear elasticity: tensors in Voigt notation, moduli derived from them, and bounds for porous solids.
#pragma once

#include <array>

#include "engine/base/geometry.h"

namespace lamella {

/// A stiffness or compliance tensor in Voigt notation: strains xx, yy, zz, xy, yz, zx with engineering shears
/// (twice the tensor's). Stiffness has the unit of the base material's modulus.
using ElasticTensor = std::array<std::array<double, 6>, 6>;

/// An isotropic elastic material. `young` may have any unit of stress; derived moduli have the same unit.
struct IsotropicMaterial {
    double young = 1;
    double poisson = 1.0 / 3;

    double bulk() const { return young / (3 * (1 - 2 * poisson)); }
    double shear() const { return young / (2 * (1 + poisson)); }
};

IsotropicMaterial material_of(double bulk, double shear);
/// Throws InputError unless Young's modulus is positive and finite, and Poisson's ratio is in (-1, 0.5).
void check_material(const IsotropicMaterial& material);
ElasticTensor stiffness_of(const IsotropicMaterial& material);

/// Returns the isotropic stiffness closest to `stiffness` in the rotation-invariant (Frobenius) norm: its
/// orthogonal projection.
IsotropicMaterial closest_isotropic(const ElasticTensor& stiffness);
/// Returns the distance from the closest isotropic stiffness, relative to the norm of that one.
double anisotropy(const ElasticTensor& stiffness);
/// Returns the inverse. Throws FaultError if the stiffness is singular: some strain
/// costs no energy.
ElasticTensor compliance_of(const ElasticTensor& stiffness);
/// Returns Young's modulus along a unit vector.
double directional_modulus(const ElasticTensor& compliance, dvec3 direction);

/// Returns the minimum and maximum of Young's modulus over a fixed set of about 4,000 directions, one or two
/// degrees apart.
Interval directional_moduli(const ElasticTensor& compliance);

/// Returns the upper Hashin-Shtrikman bound for an isotropic mixture of a material and void. `share` is the
/// solid volume fraction.
IsotropicMaterial hashin_shtrikman(const IsotropicMaterial& material, double share);

}  // namespace lamella
