// The hash of a point or cube of a lattice.
#pragma once

#include <cstddef>

#include "engine/base/geometry.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {

struct LatticeHash {
    std::size_t operator()(const glm::i64vec3& at) const {
        return static_cast<std::size_t>(CounterHash(0, 0, at.x, at.y, at.z).bits(0));
    }
};

}  // namespace lamella
