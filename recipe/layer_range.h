// Ranges of layers as people write them.
#pragma once

#include <string>

#include "engine/layers/backend.h"

namespace lamella {

/// "A:B" of `count` layers, either side may be left out; all of them for "". Throws InputError, naming
/// --layers, for what is no range of theirs.
LayerRange parse_layers(const std::string& text, int count);

}  // namespace lamella
