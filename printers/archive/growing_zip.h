// GrowingZip: a ZIP archive that is produced front to back and can be resumed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "printers/archive/zip_records.h"

namespace lamella {

/// Common base of StoredZip and DeflatedZip. They return the bytes of an archive in order; the caller writes
/// them. Only the directory is kept in memory: a few dozen bytes per entry. Equal entries give equal bytes.
class GrowingZip {
  public:
    /// Returns the directory, which ends the archive.
    std::string directory() const;
    /// Resumes an archive of which `size` bytes exist. They must be entries as made here; throws InputError
    /// otherwise.
    void take_up(const std::filesystem::path& path, std::uint64_t size);
    /// Returns the number of bytes so far.
    std::uint64_t size() const { return size_; }

  protected:
    explicit GrowingZip(ZipMethod method) : method_(method) {}
    /// Returns the local header of an entry, with capacity reserved for its data, which the caller appends.
    /// Sets the entry's offset. Throws FaultError for an empty name, a name longer than 1,024 bytes, and data
    /// of 4 GiB or more.
    std::string begin_entry(ZipEntry entry);

  private:
    ZipMethod method_;
    std::vector<ZipEntry> entries_;
    std::uint64_t size_ = 0;
};

}  // namespace lamella
