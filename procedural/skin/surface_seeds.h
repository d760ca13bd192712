// Seeds on a body's surface, about one pitch apart: random, or in a triangular lattice.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/skin/surface_walk.h"

namespace lamella {

/// The maximum number of seeds; more are refused.
inline constexpr std::size_t max_surface_seeds = 1'000'000;

/// Returns whether two surface points face away from each other, as on the two sides of a thin wall. Such
/// seeds are not neighbours, however near they are.
inline bool back_to_back(dvec3 normal, dvec3 other) { return glm::dot(normal, other) < -0.8; }

/// Returns random seeds, on average one per pitch^2 of a smooth surface, no two nearer than 0.8 pitches
/// (random sequential addition until hardly any more fit). `pitch` is in mm; `seed` is that of the random
/// numbers. Throws InputError if there would be more than max_surface_seeds.
std::vector<SurfaceFoot> scatter_on_surface(const Field& body, double pitch, std::uint64_t seed);

/// Returns seeds of a triangular lattice, each one pitch from its six neighbours, so that their cells are
/// regular hexagons where the surface is flat. The lattice grows along the surface from seed to seed, first
/// where the surface bends least. So every flat face gets one lattice, and mismatches lie where faces meet.
/// No two seeds are nearer than 0.75 pitches, and no hole is left that would hold another seed. Throws
/// InputError if there would be more than max_surface_seeds.
std::vector<SurfaceFoot> hexagons_on_surface(const Field& body, double pitch);

}  // namespace lamella
