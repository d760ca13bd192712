// Local headers, directory, and ZIP64 records for values that do not fit the plain ones.
#include "printers/archive/zip_records.h"

namespace lamella {
namespace {

constexpr std::uint32_t max_32 = 0xffffffffU;
constexpr std::size_t max_entries = 0xfffe;
constexpr std::uint32_t plain_version = 20;   // deflate and folders
constexpr std::uint32_t long_version = 45;    // 64-bit records
constexpr std::uint32_t utf8_names = 0x0800;  // flags
constexpr std::uint32_t sizes_follow = 0x0008;
constexpr std::uint32_t first_day = 0x0021;  // 1980-01-01

/// Writes the fields common to local headers and directory entries, from the required version to the length
/// of the name.
void put_common(std::string& out, const ZipEntry& entry, ZipMethod method, std::uint32_t version,
                bool with_sizes) {
    put_little(out, version, 2);
    put_little(out, utf8_names | (method == ZipMethod::deflated ? sizes_follow : 0), 2);
    put_little(out, method == ZipMethod::stored ? 0 : 8, 2);
    put_little(out, 0, 2);  // midnight
    put_little(out, first_day, 2);
    put_little(out, with_sizes ? entry.crc : 0, 4);
    put_little(out, with_sizes ? entry.packed : 0, 4);
    put_little(out, with_sizes ? entry.size : 0, 4);
    put_little(out, entry.name.size(), 2);
}

void put_in_directory(std::string& out, const ZipEntry& entry, ZipMethod method) {
    const bool far = entry.offset >= max_32;
    put_little(out, 0x02014b50, 4);
    put_little(out, far ? long_version : plain_version, 2);
    put_common(out, entry, method, far ? long_version : plain_version, true);
    put_little(out, far ? 12 : 0, 2);  // extra field
    put_little(out, 0, 2);             // no comment
    put_little(out, 0, 2);             // disk 0
    put_little(out, 0, 2);             // no internal attributes
    put_little(out, 0, 4);             // no external attributes
    put_little(out, far ? max_32 : entry.offset, 4);
    out += entry.name;
    if (!far) return;
    put_little(out, 0x0001, 2);
    put_little(out, 8, 2);
    put_little(out, entry.offset, 8);
}

}  // namespace

void put_little(std::string& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

void put_local_header(std::string& out, const ZipEntry& entry, ZipMethod method) {
    put_little(out, zip_local_header, 4);
    put_common(out, entry, method, plain_version, method != ZipMethod::deflated);
    put_little(out, 0, 2);  // no extra field
    out += entry.name;
}

void put_directory(std::string& out, std::span<const ZipEntry> entries, std::uint64_t start,
                   ZipMethod method) {
    const std::size_t before = out.size();
    for (const ZipEntry& entry : entries) put_in_directory(out, entry, method);
    const std::uint64_t length = out.size() - before, count = entries.size();
    const bool large = count > max_entries || start >= max_32 || length >= max_32;
    if (large) {
        const std::uint64_t record = start + length;
        put_little(out, 0x06064b50, 4);
        put_little(out, 44, 8);  // size of the rest of the record
        put_little(out, long_version, 2);
        put_little(out, long_version, 2);
        put_little(out, 0, 4);  // this disk
        put_little(out, 0, 4);  // the directory's disk
        put_little(out, count, 8);
        put_little(out, count, 8);
        put_little(out, length, 8);
        put_little(out, start, 8);
        put_little(out, 0x07064b50, 4);
        put_little(out, 0, 4);  // the record's disk
        put_little(out, record, 8);
        put_little(out, 1, 4);  // disks
    }
    put_little(out, 0x06054b50, 4);
    put_little(out, 0, 2);  // this disk
    put_little(out, 0, 2);  // the directory's disk
    put_little(out, large ? 0xffff : count, 2);
    put_little(out, large ? 0xffff : count, 2);
    put_little(out, large ? max_32 : length, 4);
    put_little(out, large ? max_32 : start, 4);
    put_little(out, 0, 2);  // no comment
}

}  // namespace lamella
