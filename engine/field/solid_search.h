// Search for a point inside a solid by dividing boxes.
#pragma once

#include <optional>

#include "engine/field/field.h"

namespace lamella {

/// Returns a point of the box (finite) that is in the solid; nothing when none is found. Best-first search:
/// of the parts that wait, the one with the least value at its centre less half its diagonal is halved next,
/// and each is followed down to a point towards lower values. Parts whose range proves them empty are pruned.
/// The search gives up after 20,000 parts: it may then miss a solid that is small against the box and whose
/// values do not lead to it.
std::optional<dvec3> find_solid_point(const Field& solid, const Box& box);

}  // namespace lamella
