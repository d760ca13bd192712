// Rounding down.
#pragma once

#include <glm/glm.hpp>

namespace lamella {

/// Returns the largest integer not above v, which must fit an int. std::floor is a function call on old
/// processors.
template <typename Number>
int whole_below(Number v) {
    const int towards_zero = static_cast<int>(v);
    return towards_zero - (v < static_cast<Number>(towards_zero) ? 1 : 0);
}

template <typename Number>
glm::ivec3 whole_below(const glm::vec<3, Number>& v) {
    return {whole_below(v.x), whole_below(v.y), whole_below(v.z)};
}

}  // namespace lamella
