// One field of every kind, small and about the origin, for tests that hold for all.
#pragma once

#include <string>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

struct NamedField {
    std::string name;
    FieldPtr field;
    bool sampled = false;  ///< has no closed-form runs
};

/// Returns fields whose solids lie within 4.5 mm of the origin along each axis, or reach beyond everywhere.
std::vector<NamedField> all_fields();

}  // namespace lamella
