// Tar headers with octal fields; compression by libdeflate.
#include "printers/archive/tar_gzip.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <memory>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr std::size_t tar_block = 512;

/// Writes a number into a field of a header: octal digits and a zero byte.
void put_octal(std::string& header, std::size_t at, std::size_t size, std::uint64_t value) {
    header.replace(at, size - 1, fmt::format("{:0{}o}", value, size - 1));
}

}  // namespace

std::string tar_member(const std::string& name, std::string_view content) {
    constexpr std::uint64_t most = std::uint64_t{1} << 33U;
    constexpr std::uint64_t begin_of_1980 = 315532800;  // s since 1970
    if (name.empty() || name.size() > 99 || content.size() >= most)
        throw FaultError("'" + name + "' does not fit into a tape archive");
    std::string member(tar_block, '\0');
    member.replace(0, name.size(), name);
    put_octal(member, 100, 8, 0644);  // readable by all
    put_octal(member, 108, 8, 0);     // owner
    put_octal(member, 116, 8, 0);     // group
    put_octal(member, 124, 12, content.size());
    put_octal(member, 136, 12, begin_of_1980);
    member.replace(148, 8, 8, ' ');  // the checksum field itself counts as blanks
    member[156] = '0';               // a plain file
    member.replace(257, 8, std::string_view("ustar\00000", 8));
    std::uint64_t sum = 0;
    for (const char c : member) sum += static_cast<unsigned char>(c);
    member.replace(148, 7, fmt::format("{:06o}", sum) + '\0');
    member += content;
    member.append((tar_block - content.size() % tar_block) % tar_block, '\0');
    return member;
}

std::string tar_end() {
    std::string blocks(2 * tar_block, '\0');
    return blocks;
}

std::string gzip_member(std::string_view bytes) {
    constexpr int level = 6;
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw FaultError("out of memory for compression");
    std::string out(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()), '\0');
    const std::size_t size =
        libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size());
    if (size == 0) throw FaultError("compression failed");
    out.resize(size);
    return out;
}

}  // namespace lamella
