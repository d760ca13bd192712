// The records of a ZIP archive (PKWARE APPNOTE 6.3, sections 4.3 to 4.5), for those who write one.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lamella {

/// A file in an archive.
struct ZipEntry {
    std::string name;
    std::uint64_t offset = 0;  ///< of its local header
    std::uint64_t packed = 0;  ///< bytes in the archive
    std::uint64_t size = 0;    ///< bytes of the file
    std::uint32_t crc = 0;
};

/// How entries are kept.
enum class ZipMethod : std::uint8_t {
    stored,         ///< as they are; sizes stand before the data
    deflated,       ///< sizes follow the data
    deflated_ahead  ///< sizes stand before the data
};

inline constexpr std::uint32_t zip_local_header = 0x04034b50;
inline constexpr std::size_t zip_local_header_size = 30;

/// The lowest so many bytes of a number, the least significant first.
void put_little(std::string& out, std::uint64_t value, int bytes);

/// What stands before an entry's data. All are dated 1980-01-01. Where sizes
/// follow the data, they and the sum are left out.
void put_local_header(std::string& out, const ZipEntry& entry, ZipMethod method);

/// The directory at the end of an archive, which begins `start` bytes into it. Entries beyond 4 GiB, and more
/// than 65,534 of them, take the records of the 64-bit format.
void put_directory(std::string& out, std::span<const ZipEntry> entries, std::uint64_t start,
                   ZipMethod method);

}  // namespace lamella
