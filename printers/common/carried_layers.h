// Back-ends for distributed runs: layers are rendered in one process and written in another.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/layers/backend.h"

namespace lamella {

/// Returns the packed product of a layer that was rendered elsewhere, or nothing if the layer is to be
/// rendered here. Called by several threads at once.
using FetchLayer = std::function<std::optional<std::string>(int layer)>;

/// Makes a back-end that fetches rendered layers and passes them to `outputs` as if these had rendered them.
std::unique_ptr<Backend> make_fetching(std::unique_ptr<Backend> outputs, FetchLayer fetch);

/// Receives the packed product of a layer. Called by one thread, layers in order.
using SendLayer = std::function<void(int layer, std::string bytes)>;

/// Makes a back-end that renders layers and sends them instead of writing them. It renders each layer as
/// `renderer` would in a run over all layers of `whole`, whichever layers are requested, in one run or
/// several.
std::unique_ptr<Backend> make_sending(std::unique_ptr<Backend> renderer, LayerRange whole, SendLayer send);

}  // namespace lamella
