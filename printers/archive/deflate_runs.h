// Deflate compression of grey runs, without expanding them into pixels.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"
#include "printers/archive/adler.h"

namespace lamella {

/// Compresses `rows` PNG rows (a filter byte 0, then `width` grey values each) and appends the result to
/// `out`. The output is one deflate block with its own codes and an empty stored block. It ends on a byte
/// boundary and refers to nothing before it (RFC 1951; the flush of RFC 7692), so bands can be compressed on
/// any thread and be joined in order. deflate_end closes the stream. Runs become matches at distance 1; rows
/// that repeat the row before become matches one row back.
///
/// The runs of each row must sum to `width` (1 to 65535) and may have length 0; `rows` is 1 to 4096. Throws
/// FaultError otherwise. Appends the checksum of the uncompressed bytes to `adler`.
void compress_band(std::span<const GreyRun> runs, int width, int rows, std::vector<std::byte>& out,
                   Adler& adler);

/// Appends an empty final block, which ends a deflate stream.
void deflate_end(std::vector<std::byte>& out);

}  // namespace lamella
