// Detection of unsupported parts of beads.
#pragma once

#include "printers/toolpath/bead.h"
#include "printers/toolpath/layer_below.h"

namespace lamella {

/// Splits beads where their centre line leaves the layer below, and marks the unsupported pieces. The pieces
/// follow each other and have the same total volume. Stretches shorter than the bead's width are merged into
/// their neighbours. Beads that are already marked stay unchanged.
std::vector<Bead> cut_hanging(const std::vector<Bead>& beads, const LayerBelow& footing);

}  // namespace lamella
