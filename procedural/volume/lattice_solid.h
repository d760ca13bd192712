// The solid of a 3MF beam lattice: beams, frusta, half balls and balls, united without a mesh.
#pragma once

#include <variant>
#include <vector>

#include "engine/field/field.h"
#include "engine/io/beam_lattice_3mf.h"
#include "engine/solids/beam.h"
#include "engine/solids/frustum.h"

namespace lamella {

/// The pieces of lattices, mm. A ball is a beam whose ends are one point.
struct LatticePieces {
    std::vector<Beam> beams;
    std::vector<std::variant<Frustum, HalfBall>> flat;  ///< pieces with a flat side

    std::size_t size() const { return beams.size() + flat.size(); }
};

/// Adds the pieces of a lattice over vertices, mm; `scale` is mm per unit of its radii. A beam of one radius
/// whose ends are balls or halves of balls is one piece; any other beam is a frustum with its caps beside it.
/// Beams without length are their caps.
void append_pieces(LatticePieces& pieces, const LatticeOfMesh& lattice, std::span<const dvec3> vertices,
                   double scale);

/// Makes the union of the pieces. Runs are closed forms; values are exact outside and a bound inside.
FieldPtr make_lattice_solid(LatticePieces pieces);

}  // namespace lamella
