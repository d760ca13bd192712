// Linear elasticity: tensors in Voigt's notation, what they say, and the bounds that hold for porous solids.
#pragma once

#include <array>

#include "engine/base/geometry.h"

namespace lamella {

/// A stiffness or compliance tensor: strains xx, yy, zz, xy, yz, zx, shears as engineers count them (twice
/// the tensor's). Stiffness has the unit of the base material's modulus.
using ElasticTensor = std::array<std::array<double, 6>, 6>;

/// A material alike to all sides.
struct IsotropicMaterial {
    double young = 1;
    double poisson = 1.0 / 3;

    double bulk() const { return young / (3 * (1 - 2 * poisson)); }
    double shear() const { return young / (2 * (1 + poisson)); }
};

IsotropicMaterial material_of(double bulk, double shear);
/// Throws InputError unless the modulus is positive and finite, and Poisson's ratio in (-1, 0.5).
void check_material(const IsotropicMaterial& material);
ElasticTensor stiffness_of(const IsotropicMaterial& material);

/// The isotropic stiffness nearest to one (in the norm that does not depend on the axes): its projection.
IsotropicMaterial closest_isotropic(const ElasticTensor& stiffness);
/// How far a stiffness is from the closest isotropic one, as a share of that one's norm.
double anisotropy(const ElasticTensor& stiffness);
/// The inverse. Throws FaultError for a stiffness that lets something be strained for nothing.
ElasticTensor compliance_of(const ElasticTensor& stiffness);
/// Young's modulus along a direction (a unit vector).
double directional_modulus(const ElasticTensor& compliance, dvec3 direction);

/// Least and greatest Young's modulus over a fixed set of about 4,000 directions, a degree or two apart.
Interval directional_moduli(const ElasticTensor& compliance);

/// The upper bound of Hashin and Shtrikman for an isotropic mixture of a material and void, of which `share`
/// is solid.
IsotropicMaterial hashin_shtrikman(const IsotropicMaterial& material, double share);

}  // namespace lamella
