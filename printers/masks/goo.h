// Back-end: GOO files for resin printers with 8-bit displays (vendor's specification V1.2, 2023).
#pragma once

#include <memory>
#include <string>

#include "engine/layers/backend.h"
#include "printers/common/profile.h"

namespace lamella {

/// Size of the header before the first layer, bytes.
inline constexpr std::size_t goo_header_size = 195477;

/// Makes a back-end that writes one file: a header with the machine's moves and exposures, then the grey mask
/// of each layer as it is computed, with all 256 greys. The header's volume and its two
/// previews are filled in at the end; the previews are black unless asked for. An interrupted run leaves
/// PATH.partial and can be resumed to the same bytes. The file contains no time stamp.
std::unique_ptr<Backend> make_goo(const PrinterProfile& profile, const std::string& path, bool force);

}  // namespace lamella
