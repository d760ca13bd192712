// DeflatedZip: an archive of files made of pieces that are compressed one by one, continued where it stopped.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "printers/zip_records.h"

namespace lamella {

/// A piece of a file, compressed (RFC 1951) up to a whole byte, so that pieces can follow one another.
struct DeflatedPiece {
    std::string bytes;
    std::uint64_t size = 0;  ///< of the text
    std::uint32_t crc = 0;   ///< of the text
};
/// Pure, so that pieces can be made by several threads. Equal texts give equal bytes with one build of zlib.
DeflatedPiece deflate_piece(std::string_view text);

/// Gives the bytes of an archive in order; someone else writes them. Kept in memory is the directory: a few
/// dozen bytes an entry. Equal entries give equal bytes.
class DeflatedZip {
  public:
    /// The bytes of an entry of these pieces. Throws FaultError for a name of more than 1,024 bytes, or a
    /// file of 4 GiB or more.
    std::string entry(const std::string& name, std::span<const DeflatedPiece> pieces);
    /// The same for a file in one piece.
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
