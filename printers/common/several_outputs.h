// Back-end that passes one stream of layers to several back-ends.
#pragma once

#include <memory>
#include <vector>

#include "engine/layers/backend.h"

namespace lamella {

/// Makes a back-end that passes each layer to all `outputs`. A resumed run begins at the first layer that any
/// of them lacks; a back-end does not get a layer twice.
std::unique_ptr<Backend> make_several_outputs(std::vector<std::unique_ptr<Backend>> outputs);

}  // namespace lamella
