// DeflatedZip: an archive of files made of pieces that are compressed one by one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "printers/archive/growing_zip.h"

namespace lamella {

/// A piece of a file, compressed (RFC 1951) up to a whole byte, so that pieces can follow one another.
struct DeflatedPiece {
    std::string bytes;
    std::uint64_t size = 0;  ///< of the text
    std::uint32_t crc = 0;   ///< of the text
};
/// Pure, so that pieces can be made by several threads. Equal texts give equal bytes with one build of zlib.
DeflatedPiece deflate_piece(std::string_view text);

class DeflatedZip : public GrowingZip {
  public:
    DeflatedZip() : GrowingZip(ZipMethod::deflated_ahead) {}
    /// The bytes of an entry of these pieces. Throws FaultError for a name of more than 1,024 bytes, or a
    /// file of 4 GiB or more.
    std::string entry(const std::string& name, std::span<const DeflatedPiece> pieces);
    /// The same for a file in one piece.
    std::string entry(const std::string& name, std::string_view file);
};

}  // namespace lamella
