// Pieces of a compressed tape archive, each a whole number of tape blocks and a gzip stream of its own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lamella {

/// A file of an archive: header (POSIX.1-1988, ustar), content, filling up to a block of 512 bytes. The file
/// dates from 1980-01-01. Throws FaultError for a name of more than 99 bytes or a content of 8 GiB or more.
std::string tar_member(const std::string& name, std::string_view content);

/// Two empty blocks, which end an archive.
std::string tar_end();

/// A gzip member (RFC 1952) without name and time. Members that follow each other are one stream, the
/// concatenation of what they hold, so an archive can be made piece by piece.
std::string gzip_member(std::string_view bytes);

}  // namespace lamella
