// ElementUse: what is prescribed of an element.
#pragma once

#include <cstdint>

namespace lamella {

/// What an element is, whatever the design variables say; `kept` has a density between empty and solid.
enum class ElementUse : std::uint8_t { outside, free, solid, empty, kept };

}  // namespace lamella
