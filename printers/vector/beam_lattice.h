// A foam's beams as a 3MF file with the beam lattice extension: the exact graph, for programs that take one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "engine/solids/beam.h"

namespace lamella {

/// What a lattice file holds.
struct BeamLatticeReport {
    std::size_t vertices = 0;  ///< nodes
    std::size_t beams = 0;
    std::size_t dropped = 0;  ///< beams whose two ends are written as one point, which the format forbids
};

/// Writes beams (mm) as a 3MF model: one object of nodes and beams with sphere caps, no triangles (3MF core
/// specification 1.x; beam lattice extension 1.2, section 2). Lengths are rounded to 1e-5 mm; ends that are
/// then equal are one node. Radii below 1e-5 mm are written as that.
///
/// The format's beam is a frustum between two balls, ours their convex hull: where the radii of a beam of
/// length L differ, its flank is thinner than ours by up to r (1 / cos a - 1), sin a = (ra - rb) / L.
///
/// `name` is the object's name, UTF-8; characters that XML cannot hold are left out. A file of that path is
/// replaced, once the new one is complete. Equal beams give equal bytes. Memory: 40 bytes or so a node, in
/// addition to the beams. Throws InputError when there are no beams, or one that is not finite, lies more
/// than 1e6 mm from the origin or has a radius that is not positive; FaultError when the file cannot be
/// written.
BeamLatticeReport write_beam_lattice(const std::filesystem::path& path, std::span<const Beam> beams,
                                     const std::string& name);

}  // namespace lamella
