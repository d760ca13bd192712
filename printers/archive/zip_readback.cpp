// Walks from one local header to the next.
#include "printers/archive/zip_readback.h"

#include <array>
#include <fstream>

#include "engine/base/error.h"

namespace lamella {
namespace {

std::uint64_t little(const char* bytes, int count) {
    std::uint64_t value = 0;
    for (int i = count; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

}  // namespace

std::vector<ZipEntry> read_back_entries(const std::filesystem::path& path, std::uint64_t size) {
    const auto refuse = [&] {
        throw InputError(path.string() +
                         " holds something else than an archive begun here; discard it with --force");
    };
    std::vector<ZipEntry> entries;
    std::uint64_t at = 0;
    std::ifstream in(path, std::ios::binary);
    std::array<char, zip_local_header_size> header{};
    while (at < size) {
        in.seekg(static_cast<std::streamoff>(at));
        if (!in.read(header.data(), header.size()) || little(header.data(), 4) != zip_local_header) refuse();
        ZipEntry entry;
        entry.offset = at;
        entry.crc = static_cast<std::uint32_t>(little(&header[14], 4));
        entry.packed = little(&header[18], 4);
        entry.size = little(&header[22], 4);
        entry.name.resize(static_cast<std::size_t>(little(&header[26], 2)));
        if (entry.name.empty() || entry.name.size() > longest_zip_name || little(&header[28], 2) != 0)
            refuse();
        if (!in.read(entry.name.data(), static_cast<std::streamsize>(entry.name.size()))) refuse();
        at += zip_local_header_size + entry.name.size() + entry.packed;
        entries.push_back(std::move(entry));
    }
    if (at != size) refuse();
    return entries;
}

}  // namespace lamella
