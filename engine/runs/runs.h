// Runs: a row of a layer as a sorted list of solid intervals with sub-pixel ends (dexels; thesis 2.1.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

class Archive;

/// The direction in which the lines of a band run.
enum class Axis : std::uint8_t { x, y };

/// Run ends per pitch: a run coordinate is a fixed-point number with 8 fractional bits.
inline constexpr int run_unit = 256;

/// A solid interval of a line, half-open, in 1/256 of the band's pitch along the line. Never empty.
struct Run {
    std::int32_t begin;
    std::int32_t end;
    friend bool operator==(const Run&, const Run&) = default;
};

/// A set of parallel lines in a layer's plane: `count` pixel rows (or columns) of `sub` lines each.
///
/// Run coordinate u lies at along_origin + u / 256 * along_pitch; sub-line k of row i lies at across_origin +
/// (i + (k + 1/2) / sub) * across_pitch. Pitches may be negative (mirrored displays). Pixel (i, j) therefore
/// covers run coordinates [256 j, 256 (j + 1)) of row i. Lines are numbered from the first line of row 0;
/// with a `step`, the band holds only those whose number is a multiple of it. A line has the same runs in
/// every band that holds it.
struct RowBand {
    Axis axis = Axis::x;       ///< direction of the lines
    double along_origin = 0;   ///< mm, where run coordinate 0 lies
    double along_pitch = 1;    ///< mm per pixel along the lines
    double across_origin = 0;  ///< mm, lower edge of row 0
    double across_pitch = 1;   ///< mm from row to row
    int first = 0;             ///< first row
    int count = 0;             ///< number of rows
    int sub = 1;               ///< lines per row
    int lo = 0;                ///< runs are clipped to pixels [lo, hi)
    int hi = 0;
    int step = 1;  ///< from line to line

    int lines() const { return step == 1 ? count * sub : steps_before(first + count) - steps_before(first); }
    /// Returns the number of line `l` of the band (0 <= l < lines()).
    int number(int l) const { return step == 1 ? first * sub + l : (steps_before(first) + l) * step; }
    /// Returns its position across the lines, mm.
    double line(int l) const {
        const int n = number(l), row = floor_quotient(n, sub);
        return across_origin + (row + (n - row * sub + 0.5) / sub) * across_pitch;
    }
    /// Returns the distance from line to line, mm; with the sign of across_pitch.
    double line_pitch() const { return across_pitch / sub * step; }
    /// Returns the position of run coordinate u along the lines, mm.
    double along(double u) const { return along_origin + u * (along_pitch / run_unit); }
    /// Returns the run coordinate (not rounded) of a position along the lines, mm.
    double coordinate(double p) const { return (p - along_origin) * (run_unit / along_pitch); }
    /// Returns the part of the plane that the band's rows cover, mm.
    Rect rect() const;
    friend bool operator==(const RowBand&, const RowBand&) = default;

  private:
    static int floor_quotient(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }
    /// Returns how many multiples of `step` from 0 on number lines before a row; negative for rows before row
    /// 0.
    int steps_before(int row) const { return -floor_quotient(-row * sub, step); }
};

/// Returns the point of the plane at run coordinate u, on the lower edge of row `row` (may be fractional).
inline dvec2 on_band(const RowBand& band, double u, double row) {
    const double along = band.along(u), across = band.across_origin + row * band.across_pitch;
    return band.axis == Axis::x ? dvec2(along, across) : dvec2(across, along);
}

/// Rounds a run coordinate to the nearest unit, halves upward, saturating far outside any band.
inline std::int32_t round_run(double u) {
    constexpr double limit = 1 << 30;
    return static_cast<std::int32_t>(std::floor(std::min(std::max(u, -limit), limit) + 0.5));
}

/// The runs of a band, line by line: sorted, disjoint, not touching. Lines are appended in order.
class RunRows {
  public:
    RunRows() { starts_.push_back(0); }

    void clear() {
        runs_.clear();
        starts_.assign(1, 0);
    }
    /// Reserves memory for this many lines and runs in total.
    void reserve(std::size_t lines, std::size_t runs) {
        starts_.reserve(lines + 1);
        runs_.reserve(runs);
    }
    std::size_t lines() const { return starts_.size() - 1; }
    std::span<const Run> line(std::size_t l) const {
        return {runs_.data() + starts_[l], starts_[l + 1] - starts_[l]};
    }
    std::span<const Run> runs() const { return runs_; }
    /// Returns the first line from `l` on that has a run; lines() when there is none.
    std::size_t line_with_runs(std::size_t l) const {
        constexpr std::size_t stride = 16;  // skips many lines at once
        const std::size_t count = lines();
        const std::uint32_t begin = starts_[l];
        while (l + stride <= count && starts_[l + stride] == begin) l += stride;
        while (l < count && starts_[l + 1] == begin) ++l;
        return l;
    }

    /// Adds a run to the current line. Runs come sorted by begin; one that overlaps or touches the last is
    /// joined with it. An empty run is ignored.
    void push(std::int32_t begin, std::int32_t end) {
        if (begin >= end) return;
        if (runs_.size() > starts_.back() && begin <= runs_.back().end) {
            runs_.back().end = std::max(runs_.back().end, end);
        } else {
            runs_.push_back({begin, end});
        }
    }
    /// Ends the current line.
    void end_line() { starts_.push_back(static_cast<std::uint32_t>(runs_.size())); }
    /// Ends the current line and appends empty ones, `count` lines in all.
    void end_lines(std::size_t count) {
        starts_.insert(starts_.end(), count, static_cast<std::uint32_t>(runs_.size()));
    }
    void append_line(std::span<const Run> runs) {
        runs_.insert(runs_.end(), runs.begin(), runs.end());
        end_line();
    }
    /// Appends lines [first, first + count) of other rows.
    void append_lines(const RunRows& rows, std::size_t first, std::size_t count);
    void append_lines(const RunRows& rows) { append_lines(rows, 0, rows.lines()); }
    /// Returns the sum of the lengths of all runs, in run units.
    std::int64_t total_length() const;
    /// Packs or unpacks. Throws FaultError when the bytes are no rows.
    void serialize(Archive& parcel);

    friend bool operator==(const RunRows&, const RunRows&) = default;

  private:
    std::vector<Run> runs_;
    std::vector<std::uint32_t> starts_;
};

/// Computes a set operation line by line; `out` must not be one of the operands.
void unite(const RunRows& a, const RunRows& b, RunRows& out);
void intersect(const RunRows& a, const RunRows& b, RunRows& out);
void subtract(const RunRows& a, const RunRows& b, RunRows& out);

}  // namespace lamella
