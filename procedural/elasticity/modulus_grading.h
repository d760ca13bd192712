// Cells and members of a foam that is to have a modulus, and the modulus of cells and members.
#pragma once

#include "engine/field/grading.h"
#include "procedural/elasticity/law_fit.h"

namespace lamella {

using FoamModulusPtr = std::shared_ptr<const FoamModulus>;

/// The cells (mm) that give members (mm) a modulus (MPa).
GradingPtr make_cell_for_modulus(GradingPtr modulus, GradingPtr member, FoamModulusPtr foam);
/// The members (mm) that give cells (mm) a modulus (MPa).
GradingPtr make_member_for_modulus(GradingPtr modulus, GradingPtr cell, FoamModulusPtr foam);
/// The modulus (MPa) that members (mm) give cells (mm).
GradingPtr make_modulus_of(GradingPtr cell, GradingPtr member, FoamModulusPtr foam);

}  // namespace lamella
