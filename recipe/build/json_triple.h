// A point or vector as the JSON of reports states it.
#pragma once

#include <nlohmann/json.hpp>

#include "engine/base/geometry.h"

namespace lamella {

/// The array [x, y, z].
inline nlohmann::ordered_json json_triple(dvec3 v) { return {v.x, v.y, v.z}; }

}  // namespace lamella
