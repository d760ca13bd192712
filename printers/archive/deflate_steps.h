// What runs are sent as in deflate: literals, matches one byte back, and matches one row back (RFC 1951).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/contours/coverage.h"

namespace lamella {

inline constexpr std::uint32_t min_match = 3, max_match = 258;  // bytes
inline constexpr std::uint32_t max_distance = 32768;            // bytes

/// A literal byte; or a match of 3 to 258 bytes, one byte back, which repeats it, or one row back.
using Step = std::uint16_t;
constexpr Step repeat_step(std::uint32_t length) { return static_cast<Step>(256 + length); }
constexpr Step copy_step(std::uint32_t length) { return static_cast<Step>(256 + max_match + 1 + length); }
inline constexpr std::size_t step_kinds = copy_step(max_match) + 1;

/// Turns PNG rows into steps: a filter byte 0, then the bytes of the runs. Runs of one byte go on over the
/// end of a row; rows that repeat the row before are copied from there, where they are near enough.
class StepWriter {
  public:
    /// `row_bytes` counts the filter byte.
    explicit StepWriter(std::uint32_t row_bytes) : row_bytes_(row_bytes) {}

    /// Adds a row, whose runs must outlive the next call.
    void row(std::span<const GreyRun> runs);
    /// All steps, after the last row; valid as long as the writer.
    std::span<const Step> finish();

  private:
    void write_out(std::span<const GreyRun> runs);
    void end_run();
    void end_copies();
    void make_room(std::size_t more);

    std::uint32_t row_bytes_;
    std::unique_ptr<Step[]> steps_;
    std::size_t count_ = 0, room_ = 0;
    std::uint32_t open_ = 0, copied_ = 0;  // bytes of the run, or of the copied rows, not yet written
    std::uint8_t value_ = 0;
    std::span<const GreyRun> previous_;
};

}  // namespace lamella
