// Records of a ZIP archive (PKWARE APPNOTE 6.3, sections 4.3 to 4.5), for writers.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lamella {

/// An entry of an archive.
struct ZipEntry {
    std::string name;
    std::uint64_t offset = 0;  ///< of its local header
    std::uint64_t packed = 0;  ///< size in the archive, bytes
    std::uint64_t size = 0;    ///< size of the file, bytes
    std::uint32_t crc = 0;
};

/// Storage method of entries, and the position of their sizes.
enum class ZipMethod : std::uint8_t {
    stored,         ///< uncompressed; sizes before the data
    deflated,       ///< compressed; sizes after the data
    deflated_ahead  ///< compressed; sizes before the data
};

inline constexpr std::uint32_t zip_local_header = 0x04034b50;
inline constexpr std::size_t zip_local_header_size = 30;

/// Appends the lowest `bytes` bytes of a number, the least significant first.
void put_little(std::string& out, std::uint64_t value, int bytes);

/// Appends the local header that stands before an entry's data. All entries are dated 1980-01-01. If sizes
/// follow the data, sizes and checksum are left out.
void put_local_header(std::string& out, const ZipEntry& entry, ZipMethod method);

/// Appends the directory of an archive, which begins `start` bytes into the file. Entries beyond 4 GiB, and
/// more than 65,534 entries, use the 64-bit records (ZIP64).
void put_directory(std::string& out, std::span<const ZipEntry> entries, std::uint64_t start,
                   ZipMethod method);

}  // namespace lamella
