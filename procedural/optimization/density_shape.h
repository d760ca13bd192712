// From densities to a shape: the level that keeps the volume, stray pieces, and the solid share of elements.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include "engine/base/geometry.h"

#include "procedural/optimization/element_use.h"

namespace lamella {

/// Densities of cubic elements (of squares, if size.z is 1) that fill a box, x fastest, then y, then z.
/// Between the elements' centres they are trilinear, beyond the outermost centres constant.
struct DensityGrid {
    glm::ivec3 size{0};
    std::vector<ElementUse> use;
    std::vector<double> density;

    std::size_t place(glm::ivec3 at) const {
        return static_cast<std::size_t>(at.x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(at.y) +
                    static_cast<std::size_t>(size.y) * static_cast<std::size_t>(at.z));
    }
    /// Returns the element with that number.
    glm::ivec3 element(std::size_t place) const {
        const auto x = static_cast<std::size_t>(size.x), y = static_cast<std::size_t>(size.y);
        return {static_cast<int>(place % x), static_cast<int>(place / x % y),
                static_cast<int>(place / (x * y))};
    }
};

/// Gives the elements outside the body, up to `layers` away from it, the mean of their neighbours nearer to
/// it, so that the shape does not recede from the surface of the body, by which it is cut off.
void extend_outside(DensityGrid& grid, int layers);

/// How densities between the centres of elements follow from those at them: trilinear, or by the cubics of
/// Catmull and Rom (1974), whose contours have no ridges at the centres.
enum class Interpolation : std::uint8_t { linear, cubic };

/// Returns the grid with each element cut into factor^3 (in the plane factor^2) of the same use, their
/// densities interpolated between the elements' centres; cubics are clamped to 0 to 1.
DensityGrid refined(const DensityGrid& grid, int factor, Interpolation method = Interpolation::linear);

/// Returns the means over the elements of a grid from which `values` was refined().
std::vector<double> coarsened(std::span<const double> values, glm::ivec3 size, int factor);

/// Returns the level at which the shape (where the density is above it) fills this share of the body's
/// elements, 0 to 1, to a thousandth. The elements are sampled at 64 points each.
double volume_keeping_level(const DensityGrid& grid, double share);

/// Returns the solid share of each element at a level, 0 to 1; 0 outside the body.
std::vector<double> solid_shares(const DensityGrid& grid, double level);

/// Returns the share of the body's elements that the shape fills at a level, 0 to 1.
double solid_volume(const DensityGrid& grid, double level);

struct StrayPieces {
    std::size_t pieces = 0;    ///< dropped
    std::size_t elements = 0;  ///< in them
};

/// Empties the pieces above the level, connected by faces of elements, that contain no anchored element, or
/// no loaded one if `loaded` has any. Flags are by element.
StrayPieces drop_stray_pieces(DensityGrid& grid, double level, std::span<const std::uint8_t> anchored,
                              std::span<const std::uint8_t> loaded);

/// Returns the number of the piece of each element for which `is_solid`, by faces: from 0 in order of first
/// appearance, -1 for the others.
std::vector<std::int32_t> pieces_by_faces(glm::ivec3 size, const std::function<bool(std::size_t)>& is_solid);

}  // namespace lamella
