// Render-only back-ends for worker processes.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "recipe/output/outputs.h"

namespace lamella {

/// Makes a back-end that renders for `outputs` as in a run over all layers of `whole`, whichever layers it is
/// given, and writes nothing. Files that the outputs open lie in a temporary folder, which is removed with
/// the back-end. Throws FaultError when the folder cannot be made.
std::unique_ptr<Backend> make_renderer(std::span<const Output> outputs, LayerRange whole);

/// Returns a hash of the settings that decide the bytes of outputs besides the job: outputs with equal hashes
/// can exchange rendered layers.
std::string settings_of(std::span<const Output> outputs);

}  // namespace lamella
