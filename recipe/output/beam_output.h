// Output of the foam's beams as a file (the recipe's output.beams).
#pragma once

#include <string>

#include "printers/vector/beam_lattice.h"
#include "recipe/build/build_job.h"

namespace lamella {

/// Throws InputError when the part has no beams, or when the file exists and `replace` is false.
void check_beam_output(const Recipe& recipe, const BuiltJob& built, bool replace);

/// Writes the beams that touch the recipe's box, or the part's bounds. Throws InputError when there are none.
BeamLatticeReport write_beam_output(const Recipe& recipe, const BuiltJob& built);

/// Returns "foam.3mf: 12 beams between 9 nodes, 0 too short to be written".
std::string lattice_text(const std::string& path, const BeamLatticeReport& report);

}  // namespace lamella
