// Right checksums for the chunks of a PNG file: mutations of it rarely get past wrong ones.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

namespace lamella {

inline void mend_png_checksums(std::string& bytes) {
    const auto byte = [&](std::size_t at) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at]));
    };
    constexpr std::size_t signature = 8, frame = 12;
    for (std::size_t at = signature; at + frame <= bytes.size();) {
        const std::size_t length = byte(at) << 24U | byte(at + 1) << 16U | byte(at + 2) << 8U | byte(at + 3);
        if (length > bytes.size() - at - frame) return;
        const std::size_t end = at + 8 + length;
        const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + at + 4), length + 4);
        for (std::size_t i = 0; i < 4; ++i) bytes[end + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xffU);
        at = end + 4;
    }
}

}  // namespace lamella
