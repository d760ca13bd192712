// Reading the entries of an unfinished archive from what stands before their data.
#pragma once

#include <filesystem>
#include <vector>

#include "printers/archive/zip_records.h"

namespace lamella {

inline constexpr std::size_t longest_zip_name = 1024;

/// The entries of an archive that was begun here and of which this many bytes exist, all of them whole
/// entries whose sizes stand before the data. Throws InputError when they are not.
std::vector<ZipEntry> read_back_entries(const std::filesystem::path& path, std::uint64_t size);

}  // namespace lamella
