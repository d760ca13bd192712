// GrowingZip: an archive that is made front to back, and continued where it stopped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "printers/archive/zip_records.h"

namespace lamella {

/// What StoredZip and DeflatedZip have in common. They give the bytes of an archive in order; someone else
/// writes them. Kept in memory is the directory: a few dozen bytes an entry. Equal entries give equal bytes.
class GrowingZip {
  public:
    /// The end of the archive.
    std::string directory() const;
    /// Takes up an archive of which this many bytes exist, all of them entries as made here. Throws
    /// InputError when they are not.
    void take_up(const std::filesystem::path& path, std::uint64_t size);
    /// Bytes so far.
    std::uint64_t size() const { return size_; }

  protected:
    explicit GrowingZip(ZipMethod method) : method_(method) {}
    /// What stands before an entry's data, with room for these, which the caller appends. The entry's offset
    /// is filled in here. Throws FaultError for a name that is empty or longer than 1,024 bytes, and for 4
    /// GiB or more.
    std::string begin_entry(ZipEntry entry);

  private:
    ZipMethod method_;
    std::vector<ZipEntry> entries_;
    std::uint64_t size_ = 0;
};

}  // namespace lamella
