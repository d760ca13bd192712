// Deflates 64 KiB at a time.
#include "procedural/volume/zlib_writer.h"

#include <algorithm>
#include <bit>

#include "engine/base/error.h"

namespace lamella {

namespace {

constexpr std::size_t packed_at_once = std::size_t{1} << 16U;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

}  // namespace

ZlibWriter::ZlibWriter(std::ostream& out) : out_(out), packed_(packed_at_once) {
    if (deflateInit(&zlib_, Z_DEFAULT_COMPRESSION) != Z_OK) throw FaultError("zlib cannot be started");
}

void ZlibWriter::write(std::span<const std::uint8_t> bytes) {
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), packed_at_once)))
        pack(bytes.first(std::min(bytes.size(), packed_at_once)), Z_NO_FLUSH);
}

void ZlibWriter::pack(std::span<const std::uint8_t> bytes, int flush) {
    zlib_.next_in = const_cast<Bytef*>(bytes.data());
    zlib_.avail_in = static_cast<uInt>(bytes.size());
    do {
        zlib_.next_out = packed_.data();
        zlib_.avail_out = static_cast<uInt>(packed_.size());
        deflate(&zlib_, flush);
        out_.write(reinterpret_cast<const char*>(packed_.data()),
                   static_cast<std::streamsize>(packed_.size() - zlib_.avail_out));
    } while (zlib_.avail_out == 0);
}

}  // namespace lamella
