// NrrdHeader: the header of an NRRD file, which describes its data and where they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

#include "engine/base/geometry.h"

namespace lamella {

enum class NrrdType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, real32, real64 };
enum class NrrdEncoding { raw, text, gzip };

/// The relevant fields, checked.
struct NrrdHeader {
    NrrdType type = NrrdType::uint8;
    NrrdEncoding encoding = NrrdEncoding::raw;
    bool big_endian = false;
    std::array<std::size_t, 3> size{};  ///< each at least 1, within the limits of a volume
    std::int64_t line_skip = 0;
    std::int64_t byte_skip = 0;  ///< -1: the data are at the end of the file
    std::string data_file;       ///< as written; empty if the data follow the header
    std::optional<Box> box;      ///< mm; if the file gives a box aligned with the axes
};

/// Returns the number of bytes per sample.
std::size_t sample_bytes(NrrdType type);

/// Reads up to and including the line that ends the header. Throws InputError("name: line: what").
NrrdHeader read_nrrd_header(std::istream& in, const std::string& name);

}  // namespace lamella
