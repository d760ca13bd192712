// Deflate straight from runs of grey values, without the pixels in between.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"
#include "printers/archive/adler.h"

namespace lamella {

/// Compresses `rows` PNG rows (a filter byte 0, then `width` grey values each) and appends the result to
/// `out`: one deflate block with codes of its own and an empty stored block, so that it ends on a byte border
/// and refers to nothing before it (RFC 1951; the flush of RFC 7692). Bands can hence be made anywhere and be
/// joined in order; the stream is closed by deflate_end. Runs become distance-1 matches, rows that repeat the
/// row before become matches one row back.
///
/// The runs of each row must sum to `width` (1 to 65535) and may have length 0; `rows` is 1 to 4096. Throws
/// FaultError where they do not. The checksum of the uncompressed bytes is appended to `adler`.
void compress_band(std::span<const GreyRun> runs, int width, int rows, std::vector<std::byte>& out,
                   Adler& adler);

/// Appends an empty last block, which ends a deflate stream.
void deflate_end(std::vector<std::byte>& out);

}  // namespace lamella
