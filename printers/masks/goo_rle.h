// The run-length code of GOO layers (vendor's specification V1.2, 2023).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/contours/coverage.h"

namespace lamella {

/// Codes a layer's pixels, row by row from the top left: a start byte, chunks, a sum over them. Runs of black
/// and of white take a byte, or up to four for long ones; of other greys a byte more. "Difference" chunks are
/// not used.
class GooEncoder {
  public:
    GooEncoder();
    /// The next runs; equal ones that follow each other are joined.
    void add(std::span<const GreyRun> runs);
    /// The whole code; nothing can be added after it.
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
