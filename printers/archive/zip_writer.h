// ZipWriter: an archive written front to back, its entries compressed as they come.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "printers/archive/output_file.h"
#include "printers/archive/zip_records.h"

namespace lamella {

/// Writes PATH.tmp and renames it when finished, so that PATH is whole or absent; an archive that is not
/// finished is removed. Equal entries give equal bytes (with one build of zlib): all entries are dated
/// 1980-01-01. Memory does not depend on the size of the entries. Entries and the whole stay below 4 GiB, the
/// limit of the plain format (PKWARE APPNOTE 6.3, sections 4.3 and 4.4); beyond, and when the disk is full, a
/// FaultError.
class ZipWriter {
  public:
    explicit ZipWriter(std::filesystem::path path);
    ~ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;

    /// Begins an entry: its name in the archive, with '/' between folders. Ends the one before.
    void begin_entry(std::string name);
    /// Appends to the entry.
    void write(std::string_view text);
    /// Ends the last entry, writes the directory and gives the file its name.
    void finish();

  private:
    struct Deflater;

    void deflate_all(std::string_view text, bool last);
    void end_entry();
    void put(std::string_view bytes);

    std::filesystem::path path_, unfinished_;
    OutputFile file_;
    std::unique_ptr<Deflater> deflater_;
    std::vector<ZipEntry> entries_;
    bool open_ = false;  ///< an entry is being written
    bool finished_ = false;
};

}  // namespace lamella
