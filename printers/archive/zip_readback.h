// Reads the entries of an unfinished ZIP archive from its local headers.
#pragma once

#include <filesystem>
#include <vector>

#include "printers/archive/zip_records.h"

namespace lamella {

inline constexpr std::size_t longest_zip_name = 1024;

/// Returns the entries of an unfinished archive made here, whose first `size` bytes exist. They must be
/// complete entries with the sizes before the data; throws InputError otherwise.
std::vector<ZipEntry> read_back_entries(const std::filesystem::path& path, std::uint64_t size);

}  // namespace lamella
