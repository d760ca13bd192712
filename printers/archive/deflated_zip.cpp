// Compresses pieces that end on a byte boundary, and joins their checksums.
#include "printers/archive/deflated_zip.h"

#include <zlib.h>

#include <limits>
#include <utility>

#include "engine/base/error.h"

namespace lamella {
namespace {

/// An empty final block: three bits for its type, seven for the end-of-block code.
constexpr std::string_view last_block("\x03\x00", 2);

}  // namespace

DeflatedPiece deflate_piece(std::string_view text) {
    if (text.size() >= std::numeric_limits<std::uint32_t>::max())
        throw FaultError("a piece of an archive reaches 4 GiB");
    constexpr int raw_window = -15, memory = 8;
    z_stream stream{};
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, raw_window, memory, Z_DEFAULT_STRATEGY) !=
        Z_OK) {
        throw FaultError("there is no memory left to compress with");
    }
    DeflatedPiece piece;
    piece.size = text.size();
    constexpr std::size_t flush = 16;  // bytes that the byte alignment may take
    piece.bytes.resize(deflateBound(&stream, text.size()) + flush);
    // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast, cppcoreguidelines-pro-type-const-cast): zlib's
    // input is not const, though it is never written to
    const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
    piece.crc = static_cast<std::uint32_t>(crc32_z(0, bytes, text.size()));
    stream.next_in = const_cast<Bytef*>(bytes);
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(piece.bytes.data());
    stream.avail_out = static_cast<uInt>(piece.bytes.size());
    // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast, cppcoreguidelines-pro-type-const-cast)
    deflate(&stream, Z_SYNC_FLUSH);
    const bool whole = stream.avail_in == 0 && stream.avail_out > 0;
    piece.bytes.resize(stream.total_out);
    deflateEnd(&stream);
    if (!whole) throw FaultError("a piece of an archive could not be compressed");
    return piece;
}

std::string DeflatedZip::entry(const std::string& name, std::span<const DeflatedPiece> pieces) {
    ZipEntry made{name, 0, last_block.size(), 0, 0};
    for (const DeflatedPiece& piece : pieces) {
        made.crc =
            static_cast<std::uint32_t>(crc32_combine(made.crc, piece.crc, static_cast<z_off_t>(piece.size)));
        made.size += piece.size;
        made.packed += piece.bytes.size();
    }
    std::string bytes = begin_entry(std::move(made));
    for (const DeflatedPiece& piece : pieces) bytes += piece.bytes;
    bytes += last_block;
    return bytes;
}

std::string DeflatedZip::entry(const std::string& name, std::string_view file) {
    const DeflatedPiece piece = deflate_piece(file);
    return entry(name, {&piece, 1});
}

}  // namespace lamella
