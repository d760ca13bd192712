// One stream of layers to several back-ends.
#pragma once

#include <memory>
#include <vector>

#include "engine/layers/backend.h"

namespace lamella {

/// Hands each layer to all of the back-ends. A continued run begins at the first layer that any of them
/// lacks; those that have it already are not given it again.
std::unique_ptr<Backend> make_several_outputs(std::vector<std::unique_ptr<Backend>> outputs);

}  // namespace lamella
