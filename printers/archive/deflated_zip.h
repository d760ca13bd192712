// DeflatedZip: a ZIP archive of files that are compressed piece by piece.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "printers/archive/growing_zip.h"

namespace lamella {

/// A compressed piece of a file (RFC 1951). It ends on a byte boundary, so that pieces can be concatenated.
struct DeflatedPiece {
    std::string bytes;
    std::uint64_t size = 0;  ///< size of the uncompressed text, bytes
    std::uint32_t crc = 0;   ///< CRC-32 of the uncompressed text
};
/// Compresses a piece. Pure: several threads may compress pieces at once. Equal texts give equal bytes with
/// one build of zlib.
DeflatedPiece deflate_piece(std::string_view text);

class DeflatedZip : public GrowingZip {
  public:
    DeflatedZip() : GrowingZip(ZipMethod::deflated_ahead) {}
    /// Returns the bytes of an entry that consists of these pieces. Throws FaultError for a name of more than
    /// 1,024 bytes, or a file of 4 GiB or more.
    std::string entry(const std::string& name, std::span<const DeflatedPiece> pieces);
    /// Returns the bytes of an entry with a single piece.
    std::string entry(const std::string& name, std::string_view file);
};

}  // namespace lamella
