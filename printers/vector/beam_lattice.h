// Export of a foam's beams as 3MF with the beam lattice extension: the exact graph.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "engine/solids/beam.h"

namespace lamella {

/// Counts of a written lattice file.
struct BeamLatticeReport {
    std::size_t vertices = 0;  ///< nodes
    std::size_t beams = 0;
    std::size_t dropped = 0;  ///< beams whose ends round to one point, which the format forbids
};

/// Writes beams (mm) as a 3MF model: one object of nodes and beams with sphere caps, no triangles (3MF core
/// specification 1.x; beam lattice extension 1.2, section 2). Coordinates are rounded to 1e-5 mm; ends that
/// are then equal share a node. Radii below 1e-5 mm are written as 1e-5 mm.
///
/// The format's beam is a frustum between two balls, ours is their convex hull. If the radii at the ends of a
/// beam of length L differ, the flank of the format's beam is thinner by up to r (1 / cos a - 1), sin a = (ra
/// - rb) / L.
///
/// `name` is the object's name, UTF-8; characters that XML cannot represent are dropped. An existing file is
/// replaced once the new one is complete. Equal beams give equal bytes. Memory: about 40 bytes per node, in
/// addition to the beams. Throws InputError if there are no beams, or if a beam is not finite, lies more than
/// 1e6 mm from the origin or has a radius that is not positive; FaultError if the file cannot be written.
BeamLatticeReport write_beam_lattice(const std::filesystem::path& path, std::span<const Beam> beams,
                                     const std::string& name);

}  // namespace lamella
