// StoredZip: an archive of files that are compressed already, made front to back and continued where it
// stopped.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "printers/zip_records.h"

namespace lamella {

/// Gives the bytes of an archive in order; someone else writes them. Kept in memory is the directory: a few
/// dozen bytes an entry. Equal entries give equal bytes.
class StoredZip {
  public:
    /// The bytes of an entry. Throws FaultError for a name of more than 1,024 bytes, or a file of 4 GiB or
    /// more.
    std::string entry(const std::string& name, std::string_view file);
    /// The end of the archive.
    std::string directory() const;
    /// Takes up an archive of which this many bytes exist, all of them entries as made here. Throws
    /// InputError when they are not.
    void take_up(const std::filesystem::path& path, std::uint64_t size);
    /// Bytes so far.
    std::uint64_t size() const { return size_; }

  private:
    std::vector<ZipEntry> entries_;
    std::uint64_t size_ = 0;
};

}  // namespace lamella
