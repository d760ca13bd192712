// Back-end: GOO files for resin printers with 8-bit displays (vendor's specification V1.2, 2023).
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Bytes of the header, before the first layer.
inline constexpr std::size_t goo_header_size = 195477;

/// Writes one file: a header with the machine's moves and exposures, then each layer's grey mask, exact in
/// its 256 greys, as it is computed. The header's volume is put in at the end; its two previews are black. A
/// stopped run leaves PATH.partial, and a later one goes on from there to the same bytes. Nothing in it tells
/// the time.
std::unique_ptr<Backend> make_goo(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
