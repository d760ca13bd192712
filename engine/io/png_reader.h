// Reads PNG images without the large image library.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "engine/io/image_file.h"

namespace lamella {

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// Opens a PNG file in memory, which must outlive the reader. Palettes become colours, samples of fewer bits
/// 8 bits; a transparent colour becomes an alpha channel. Returns null when the header cannot be read; `why`
/// then says what is wrong.
std::unique_ptr<ImageReader> open_png(std::string_view bytes, std::string& why);
/// The same for a file whose bytes the reader keeps.
std::unique_ptr<ImageReader> open_kept_png(std::string bytes, std::string& why);

}  // namespace lamella
