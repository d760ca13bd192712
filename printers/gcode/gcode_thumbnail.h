// Thumbnails of a job in the comments of a G-code file.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "engine/base/picture.h"

namespace lamella {

/// Returns a large and a small picture as PNG files in base64, between the marker lines that PrusaSlicer
/// introduced and that hosts and printers' displays look for. Empty if there is no picture. No line is longer
/// than 80 bytes.
std::string gcode_thumbnails(const std::function<Picture(int size)>& picture);

/// Encodes bytes in base64 with padding (RFC 4648, section 4).
std::string base64(std::string_view bytes);

}  // namespace lamella
