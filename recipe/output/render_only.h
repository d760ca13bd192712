// Render-only back-ends for worker processes.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "recipe/output/outputs.h"

namespace lamella {

/// The rendering of outputs alone, as in a run of all layers of `whole`, whichever of them are asked for:
/// what they open lies in a folder of its own, which is removed with the back-end. Throws FaultError where
/// that cannot be made.
std::unique_ptr<Backend> make_renderer(std::span<const Output> outputs, LayerRange whole);

/// What decides the bytes of outputs besides the job: two lists with equal words take each other's layers.
std::string settings_of(std::span<const Output> outputs);

}  // namespace lamella
