// Counts the pages of a TIFF file, and checks that the file is complete.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

namespace lamella {

/// Returns the number of pages along the chain of directories of a TIFF or BigTIFF file (TIFF 6.0, section
/// 2); none if it is not a TIFF. This is needed because image readers take a truncated chain for the end of
/// the file, so that pages would be lost silently, and do not reliably notice missing samples. Throws
/// InputError("name: what") for a chain that leaves the file or is circular, and for strips and tiles beyond
/// the end of the file.
std::optional<std::size_t> count_tiff_pages(std::istream& in, const std::string& name);

}  // namespace lamella
