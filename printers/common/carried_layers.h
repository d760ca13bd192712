// Layers that are rendered in one process and written in another.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/layers/backend.h"

namespace lamella {

/// The packed product of a layer that was rendered elsewhere; nothing where it is to be rendered here. Called
/// by several threads at once.
using FetchLayer = std::function<std::optional<std::string>(int layer)>;

/// A back-end that fetches its layers and hands them to `outputs` as if these had rendered them.
std::unique_ptr<Backend> make_fetching(std::unique_ptr<Backend> outputs, FetchLayer fetch);

/// Takes the packed product of a layer; called by one thread, layers in order.
using SendLayer = std::function<void(int layer, std::string bytes)>;

/// A back-end that renders layers as `renderer` does in a run of all layers of `whole`, whichever of them are
/// asked for, in one run or several, and sends them instead of writing them.
std::unique_ptr<Backend> make_sending(std::unique_ptr<Backend> renderer, LayerRange whole, SendLayer send);

}  // namespace lamella
