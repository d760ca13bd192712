// SupportPoint: a place where a part must be held from below while it is printed.
#pragma once

#include <cstdint>

#include "engine/base/geometry.h"

namespace lamella {

/// The reason why a place must be held.
enum class SupportReason : std::uint8_t {
    overhang,  ///< the outline stands out too far over the layer below
    island,    ///< a piece begins with nothing below it
    span,      ///< a ceiling too wide to be bridged
    stability  ///< the print would topple
};

/// A point on the lower side of the lowest layer that needs it, mm.
struct SupportPoint {
    dvec3 at{0};
    SupportReason reason = SupportReason::overhang;
    friend bool operator==(const SupportPoint&, const SupportPoint&) = default;
};

}  // namespace lamella
