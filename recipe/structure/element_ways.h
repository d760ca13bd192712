// The direction that a recipe states for the x axis of elements.
#pragma once

#include <array>
#include <optional>

#include "recipe/build/build_gradings.h"

namespace lamella {

class ElementWays {
  public:
    ElementWays(std::array<GradingPtr, 3> parts, bool is_flat)
        : parts_(std::move(parts)), is_flat_(is_flat) {}

    /// Returns the direction at a point, a unit vector, in a plate one of its plane; x where the recipe's has
    /// no length.
    dvec3 at(dvec3 p) const;

  private:
    std::array<GradingPtr, 3> parts_;
    bool is_flat_;
};

/// Returns the ways of the recipe's elements; nothing if it states none. Throws as Gradings::resolve().
std::optional<ElementWays> element_ways(const Recipe& recipe, Gradings& gradings);

}  // namespace lamella
