// Beams and balls of 3MF's beam lattice extension (1.2), read from their XML and checked.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/io/model_3mf.h"

namespace lamella {

/// How a beam ends: with the ball around its vertex, with the half of it beyond the vertex, or flat.
enum class BeamCap : std::uint8_t { sphere, hemisphere, butt };

/// A frustum between two vertices of the mesh, with its ends.
struct LatticeBeam {
    std::array<std::uint32_t, 2> vertices{};
    std::array<double, 2> radii{};  ///< in the model's unit
    std::array<BeamCap, 2> caps{};
};

struct LatticeBall {
    std::uint32_t vertex = 0;
    double radius = 0;  ///< in the model's unit
};

/// Which part of a lattice is kept: all of it, or what lies in, or outside, the clipping mesh.
enum class LatticeClipping : std::uint8_t { none, inside, outside };

/// A <beamlattice>. Sets of beams, properties and the mesh for previews do not change the shape and are not
/// read.
struct LatticeOfMesh {
    std::vector<LatticeBeam> beams;
    std::vector<LatticeBall> balls;
    LatticeClipping clipping = LatticeClipping::none;
    std::int64_t clipping_mesh = 0;  ///< object
};

/// Returns the <beamlattice> of a <mesh>; an empty node without one.
pugi::xml_node lattice_node(const pugi::xml_node& mesh);

/// Returns the number of its <beam> elements.
std::size_t count_beams(const pugi::xml_node& lattice);

/// Reads a <beamlattice> whose mesh has `vertex_count` vertices. Throws InputError with the place for what
/// the extension does not allow: vertices that do not exist, beams from a vertex to itself, radii that are
/// not positive, words that are not known.
LatticeOfMesh read_lattice(const Model3mf& model, const ModelPart& in, const pugi::xml_node& lattice,
                           std::size_t vertex_count);

}  // namespace lamella
