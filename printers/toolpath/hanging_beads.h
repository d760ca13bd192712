// Which parts of beads have nothing under them.
#pragma once

#include "printers/toolpath/bead.h"
#include "printers/toolpath/layer_below.h"

namespace lamella {

/// Cuts beads where their middle leaves what is under them, and marks what hangs; the pieces follow each
/// other and lay the same volume. Stretches shorter than a bead's own width count as what lies beside them.
/// Beads that are marked already stay as they are.
std::vector<Bead> cut_hanging(const std::vector<Bead>& beads, const LayerBelow& footing);

}  // namespace lamella
