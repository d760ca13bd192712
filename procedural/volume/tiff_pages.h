// How many pages a TIFF file says it has, and whether all of it is there.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

namespace lamella {

/// Pages along the chain of directories of a TIFF or BigTIFF file (TIFF 6.0, section 2); nothing when it is
/// no TIFF. A reader takes a chain that is cut off for one that has ended, so that pages would be lost
/// unseen; nor does it notice for sure that samples are missing. Throws InputError("name: what") for a chain
/// that leads out of the file or round in circles, and for strips and tiles that lie beyond its end.
std::optional<std::size_t> count_tiff_pages(std::istream& in, const std::string& name);

}  // namespace lamella
