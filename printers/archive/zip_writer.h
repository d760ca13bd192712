// ZipWriter: a ZIP archive that is written front to back and compresses its entries as they arrive.
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

/// Writes PATH.tmp and renames it when finished, so that PATH is complete or absent; an unfinished archive is
/// removed. Equal entries give equal bytes (with one build of zlib): all entries are dated 1980-01-01. Memory
/// does not depend on the size of the entries. Each entry and the archive must stay below 4 GiB, the limit of
/// the plain format (PKWARE APPNOTE 6.3, sections 4.3 and 4.4); throws FaultError beyond it, and when the
/// disk is full.
class ZipWriter {
  public:
    explicit ZipWriter(std::filesystem::path path);
    ~ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;

    /// Begins an entry and ends the one before. The name is the path in the archive, with '/' between
    /// folders.
    void begin_entry(std::string name);
    /// Appends to the current entry.
    void write(std::string_view text);
    /// Ends the last entry, writes the directory and renames the file.
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
