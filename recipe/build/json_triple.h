// Points and vectors in the JSON of reports.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the array [x, y, z].
inline nlohmann::ordered_json json_triple(dvec3 v) { return {v.x, v.y, v.z}; }

}  // namespace lamella
