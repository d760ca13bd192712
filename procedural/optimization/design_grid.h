// DesignGrid: the elements of a regular grid that belong to the body, for the maps from design variables to
// densities.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/base/error.h"

namespace lamella {

/// Elements are stored x fastest, then y, then z. A grid with size.z = 1 is two-dimensional: one plane of
/// squares, not a slab of cubes.
class DesignGrid {
  public:
    /// Takes the size in elements and the mask of the domain, one number per element: 0 outside the body.
    /// Throws InputError if a side is below 1 or the mask has another number of elements.
    DesignGrid(glm::ivec3 size, std::span<const std::uint8_t> domain) : size_(size) {
        if (size.x < 1 || size.y < 1 || size.z < 1)
            throw InputError("a design grid of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                             " x " + std::to_string(size.z) + " elements: every side must be at least 1");
        check(domain.size(), "the mask of the domain");
        inside_.assign(domain.begin(), domain.end());
    }

    glm::ivec3 size() const { return size_; }
    bool flat() const { return size_.z == 1; }
    std::size_t elements() const {
        return static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
               static_cast<std::size_t>(size_.z);
    }
    std::size_t place(int x, int y, int z) const {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(size_.x) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(z));
    }
    bool inside(std::size_t element) const { return inside_[element] != 0; }

    /// Throws InputError unless `count` is the number of elements; `what` begins the message.
    void check(std::size_t count, const char* what) const {
        if (count != elements())
            throw InputError(std::string(what) + " has " + std::to_string(count) + " numbers; the grid has " +
                             std::to_string(elements()) + " elements");
    }

  private:
    glm::ivec3 size_;
    std::vector<std::uint8_t> inside_;
};

}  // namespace lamella
