// Seeds on a body's surface, about one pitch apart: at random, or six about each.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/skin/surface_walk.h"

namespace lamella {

/// More seeds than this are refused.
inline constexpr std::size_t max_surface_seeds = 1'000'000;

/// Two places face away from each other, as those on the two sides of a thin wall do. They are no
/// neighbours, however near they are.
inline bool back_to_back(dvec3 normal, dvec3 other) { return glm::dot(normal, other) < -0.8; }

/// Seeds at random, one to every pitch^2 of a smooth surface on average, none nearer to another than 0.8
/// pitches (random sequential addition until hardly any more fits). `pitch` in mm; another `seed`, other
/// places. Throws InputError where there would be more than max_surface_seeds.
std::vector<SurfaceFoot> scatter_on_surface(const Field& body, double pitch, std::uint64_t seed);

/// Seeds of a triangular lattice, each a pitch from its six neighbours, so that their cells are regular
/// hexagons where the surface is flat. The lattice grows along the surface from seed to seed, where the
/// surface bends least first, so that every flat face gets one lattice and what does not fit together meets
/// where faces meet; no two seeds are nearer than 0.75 pitches, and no hole is left that would hold another.
/// Throws InputError where there would be more than max_surface_seeds.
std::vector<SurfaceFoot> hexagons_on_surface(const Field& body, double pitch);

}  // namespace lamella
