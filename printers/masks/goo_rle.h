// GooEncoder: the run-length code of GOO layers (vendor's specification V1.2, 2023).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"

namespace lamella {

/// Encodes a layer's pixels, row by row from the top left: a start byte, chunks, and a checksum of the
/// chunks. A run of black or white takes one byte, a long one up to four; a run of another grey takes one
/// byte more. "Difference" chunks are not used.
class GooEncoder {
  public:
    GooEncoder();
    /// Appends runs. Successive runs of equal grey are joined.
    void add(std::span<const GreyRun> runs);
    /// Returns the whole code. No run can be appended afterwards.
    std::vector<std::byte> finish();

  private:
    void flush();
    void put(std::uint32_t byte);

    std::vector<std::byte> bytes_;
    std::uint32_t sum_ = 0;
    std::uint8_t value_ = 0;
    std::uint64_t length_ = 0;
};

}  // namespace lamella
