// StepWriter: turns grey runs into deflate literals, matches one byte back and matches one row back (RFC
// 1951).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/contours/coverage.h"

namespace lamella {

inline constexpr std::uint32_t min_match = 3, max_match = 258;  // bytes
inline constexpr std::uint32_t max_distance = 32768;            // bytes

/// One step of the encoding: a literal byte, a match of 3 to 258 bytes one byte back (it repeats that byte),
/// or a match of the same length one row back.
using Step = std::uint16_t;
constexpr Step repeat_step(std::uint32_t length) { return static_cast<Step>(256 + length); }
constexpr Step copy_step(std::uint32_t length) { return static_cast<Step>(256 + max_match + 1 + length); }
inline constexpr std::size_t step_kinds = copy_step(max_match) + 1;

/// Turns PNG rows (a filter byte 0, then the bytes of the runs) into steps. A run of equal bytes continues
/// across the end of a row. A row that repeats the row before is copied from there, if a row is short enough
/// for the match distance.
class StepWriter {
  public:
    /// `row_bytes` includes the filter byte.
    explicit StepWriter(std::uint32_t row_bytes) : row_bytes_(row_bytes) {}

    /// Appends a row. Its runs must stay valid until the next call has returned.
    void row(std::span<const GreyRun> runs);
    /// Returns all steps, after the last row. The span is valid as long as the writer.
    std::span<const Step> finish();

  private:
    void write_out(std::span<const GreyRun> runs);
    void end_run();
    void end_copies();
    void make_room(std::size_t more);

    std::uint32_t row_bytes_;
    std::unique_ptr<Step[]> steps_;
    std::size_t count_ = 0, room_ = 0;
    std::uint32_t open_ = 0, copied_ = 0;  // pending bytes of the current run, or of the copied rows
    std::uint8_t value_ = 0;
    std::span<const GreyRun> previous_;
};

}  // namespace lamella
