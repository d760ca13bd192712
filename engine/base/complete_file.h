// Files that are complete or not there.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace lamella {

/// Writes a file under a temporary name beside it, and renames that once all is written: nobody sees half a
/// file, and processes that write the same one at a time do not mix. Throws FaultError when the file cannot
/// be written, and whatever `write` throws; then the temporary file is gone and an older file is as it was.
void write_complete_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace lamella
