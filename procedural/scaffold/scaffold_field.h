// The solid of a scaffold, never meshed: pillars, bars, connectors and feet with closed-form runs.
#pragma once

#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// The union of a scaffold's pieces: crosses of two walls (or round pillars) on feet, bars, round cones.
/// Values are exact outside and a bound inside. Empty where the scaffold is.
FieldPtr make_scaffold_field(const Scaffold& scaffold);

}  // namespace lamella
