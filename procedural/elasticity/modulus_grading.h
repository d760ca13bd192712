// Gradings that relate a foam's modulus to the sizes of its cells and members.
#pragma once

#include "engine/field/grading.h"
#include "procedural/elasticity/law_fit.h"

namespace lamella {

using FoamModulusPtr = std::shared_ptr<const FoamModulus>;

/// Returns the cell size (mm) at which members of a given size (mm) give a wanted modulus (MPa).
GradingPtr make_cell_for_modulus(GradingPtr modulus, GradingPtr member, FoamModulusPtr foam);
/// Returns the member size (mm) at which cells of a given size (mm) give a wanted modulus (MPa).
GradingPtr make_member_for_modulus(GradingPtr modulus, GradingPtr cell, FoamModulusPtr foam);
/// Returns the modulus (MPa) of a foam with these cells (mm) and members (mm).
GradingPtr make_modulus_of(GradingPtr cell, GradingPtr member, FoamModulusPtr foam);

}  // namespace lamella
