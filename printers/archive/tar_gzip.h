// Pieces of a tar.gz archive: each is a whole number of tar blocks and a gzip member of its own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lamella {

/// Returns a file of a tar archive: header (POSIX.1-1988, ustar), content, padding to a block of 512 bytes.
/// The file is dated 1980-01-01. Throws FaultError for a name of more than 99 bytes or a content of 8 GiB or
/// more.
std::string tar_member(const std::string& name, std::string_view content);

/// Returns the two empty blocks that end an archive.
std::string tar_end();

/// Compresses bytes into a gzip member (RFC 1952) without name and time. Concatenated members decompress to
/// the concatenation of their contents, so an archive can be made piece by piece.
std::string gzip_member(std::string_view bytes);

}  // namespace lamella
