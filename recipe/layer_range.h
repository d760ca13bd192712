// Parsing of layer ranges such as "10:20".
#pragma once

#include <string>

#include "engine/layers/backend.h"

namespace lamella {

/// Parses "A:B" (either side may be missing) for a job of `count` layers; "" means all layers. Throws
/// InputError, naming --layers, for any other text or a range outside the job.
LayerRange parse_layers(const std::string& text, int count);

}  // namespace lamella
