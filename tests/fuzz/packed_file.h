// Files with a zlib stream behind their magic, made of what a fuzzer proposes.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace lamella {

/// Returns the file: of an even first byte the rest as it is, of an odd one packed behind the magic and a 0,
/// since bytes that change seldom fit the checksum.
inline std::string packed_file(const std::string& magic, const std::uint8_t* data, std::size_t size) {
    if (size == 0) return "";
    if (data[0] % 2 == 0) return {reinterpret_cast<const char*>(data) + 1, size - 1};
    uLongf length = compressBound(size - 1);
    std::vector<Bytef> packed(length);
    if (compress2(packed.data(), &length, data + 1, size - 1, 1) != Z_OK) std::abort();
    return magic + std::string(1, '\0') +
           std::string(packed.begin(), packed.begin() + static_cast<long>(length));
}

}  // namespace lamella
