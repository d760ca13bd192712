// Pictures of a job in the comments of a G-code file.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "engine/base/picture.h"

namespace lamella {

/// A large and a small picture as PNG files in base64, between lines that PrusaSlicer introduced and hosts
/// and printers' displays look for; empty where there is no picture. No line is longer than 80 bytes.
std::string gcode_thumbnails(const std::function<Picture(int size)>& picture);

/// Base64 with padding (RFC 4648, section 4).
std::string base64(std::string_view bytes);

}  // namespace lamella
