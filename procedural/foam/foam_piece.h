// FoamPiece: a piece of a foam with walls, a beam or a round triangle.
#pragma once

#include <variant>
#include <vector>

#include "engine/solids/beam.h"
#include "engine/solids/round_triangle.h"
#include "procedural/foam/plane_strips.h"

namespace lamella {

/// A beam or a wall.
using FoamPiece = std::variant<Beam, RoundTriangle>;

inline double signed_distance(const FoamPiece& piece, dvec3 p) {
    return std::visit([&](const auto& solid) { return signed_distance(solid, p); }, piece);
}

/// A beam or a wall in the form from which distances are quick.
using PreparedPiece = std::variant<RoundCone, RoundTriangle>;

inline PreparedPiece prepared(const FoamPiece& piece) {
    if (const auto* beam = std::get_if<Beam>(&piece)) return RoundCone(*beam);
    return std::get<RoundTriangle>(piece);
}

inline double signed_distance(const PreparedPiece& piece, dvec3 p) {
    return std::visit([&](const auto& solid) { return signed_distance(solid, p); }, piece);
}

inline Box bounds(const FoamPiece& piece) {
    return std::visit([](const auto& solid) { return bounds(solid); }, piece);
}

inline void put_into(PlanePieces& pieces, const FoamPiece& piece) {
    if (const auto* beam = std::get_if<Beam>(&piece)) pieces.beams.push_back(*beam);
    if (const auto* wall = std::get_if<RoundTriangle>(&piece)) pieces.walls.push_back(*wall);
}

/// Returns whether the closed solid and the closed box have a point in common; exact up to rounding.
bool touches(const RoundTriangle& triangle, const Box& box);
bool touches(const FoamPiece& piece, const Box& box);

}  // namespace lamella
