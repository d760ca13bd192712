// The solid of a scaffold as a field, without a mesh: pillars, bars, connectors and feet with closed-form
// runs.
#pragma once

#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// Makes the union of a scaffold's pieces: crossed walls (or round pillars) on feet, bars, and round cones.
/// Values are exact outside and a bound inside. An empty scaffold gives an empty field.
FieldPtr make_scaffold_field(const Scaffold& scaffold);

}  // namespace lamella
