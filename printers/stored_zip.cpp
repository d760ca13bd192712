// Entries one after another, and reading their headers back.
#include "printers/stored_zip.h"

#include <zlib.h>

#include <array>
#include <fstream>

#include "engine/error.h"

namespace lamella {
namespace {

constexpr std::size_t longest_name = 1024;
constexpr std::uint64_t most_bytes = 0xfffffffeU;

std::uint64_t little(const char* bytes, int count) {
    std::uint64_t value = 0;
    for (int i = count; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

std::uint32_t checksum(std::string_view file) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): zlib speaks of unsigned char
    const auto* bytes = reinterpret_cast<const Bytef*>(file.data());
    return static_cast<std::uint32_t>(crc32_z(0, bytes, file.size()));
}

}  // namespace

std::string StoredZip::entry(const std::string& name, std::string_view file) {
    if (name.empty() || name.size() > longest_name)
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
    const auto refuse = [&] {
        throw InputError(path.string() +
                         " holds something else than an archive begun here; discard it with --force");
    };
    entries_.clear();
    size_ = 0;
    std::ifstream in(path, std::ios::binary);
    std::array<char, zip_local_header_size> header{};
    while (size_ < size) {
        in.seekg(static_cast<std::streamoff>(size_));
        if (!in.read(header.data(), header.size()) || little(header.data(), 4) != zip_local_header) refuse();
        ZipEntry entry;
        entry.offset = size_;
        entry.crc = static_cast<std::uint32_t>(little(&header[14], 4));
        entry.packed = entry.size = little(&header[18], 4);
        entry.name.resize(little(&header[26], 2));
        if (entry.name.empty() || entry.name.size() > longest_name || little(&header[28], 2) != 0) refuse();
        if (!in.read(entry.name.data(), static_cast<std::streamsize>(entry.name.size()))) refuse();
        size_ += zip_local_header_size + entry.name.size() + entry.size;
        entries_.push_back(std::move(entry));
    }
    if (size_ != size) refuse();
}

}  // namespace lamella
