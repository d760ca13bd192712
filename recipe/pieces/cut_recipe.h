// CutRecipe: a plane by which the part is cut, and how the pieces are joined again.
#pragma once

#include <cstdint>
#include <string>

#include "engine/base/geometry.h"

namespace lamella {

/// How two pieces are aligned: not at all, by pins of the lower one in holes of the upper one, or by holes in
/// both for rods.
enum class CutJoint : std::uint8_t { none, pins, dowels };

/// Lengths in mm.
struct CutRecipe {
    std::string where;  ///< where the entry begins, for messages
    dvec3 at{0};        ///< a point of the plane
    dvec3 normal{0, 0, 1};
    CutJoint joint = CutJoint::none;
    int joints = 0;           ///< 2 or 3, for each pair of pieces; 0: three where there is room
    double diameter = 4;      ///< of pins and rods
    double depth = 6;         ///< of a hole in each piece
    double clearance = 0.15;  ///< between pin and hole, all around
    double wall = 1.6;        ///< around a hole
    double face = 0;          ///< thickness of solid material along the cut; 0: the part's own
};

}  // namespace lamella
