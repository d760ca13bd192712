// Entries one after another.
#include "printers/stored_zip.h"

#include <zlib.h>

#include "engine/error.h"
#include "printers/zip_readback.h"

namespace lamella {
namespace {

constexpr std::uint64_t most_bytes = 0xfffffffeU;

std::uint32_t checksum(std::string_view file) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): zlib speaks of unsigned char
    const auto* bytes = reinterpret_cast<const Bytef*>(file.data());
    return static_cast<std::uint32_t>(crc32_z(0, bytes, file.size()));
}

}  // namespace

std::string StoredZip::entry(const std::string& name, std::string_view file) {
    if (name.empty() || name.size() > longest_zip_name)
        throw FaultError("an archive holds names of 1 to 1024 bytes");
    if (file.size() > most_bytes) throw FaultError(name + " is 4 GiB or more, too much for an archive");
    const ZipEntry made{name, size_, file.size(), file.size(), checksum(file)};
    std::string bytes;
    bytes.reserve(zip_local_header_size + name.size() + file.size());
    put_local_header(bytes, made, ZipMethod::stored);
    bytes += file;
    size_ += bytes.size();
    entries_.push_back(made);
    return bytes;
}

std::string StoredZip::directory() const {
    std::string bytes;
    put_directory(bytes, entries_, size_, ZipMethod::stored);
    return bytes;
}

void StoredZip::take_up(const std::filesystem::path& path, std::uint64_t size) {
    entries_ = read_back_entries(path, size);
    size_ = size;
}

}  // namespace lamella
