// BeamGroup: up to eight beams, prepared together by SIMD for the row kernel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/solids/beam.h"
#include "engine/solids/line_frame.h"

namespace lamella {

/// Beams that intersect the lines of a band, in coordinates along and across the lines (mm). Lanes of
/// doubles.
class BeamGroup {
  public:
    static constexpr std::size_t most = 8;

    /// Prepares beams for the plane at height z, mm.
    BeamGroup(const RowBand& band, double z) : band_(band), z_(z) {}

    std::size_t size() const { return size_; }
    bool full() const { return size_ == most; }
    /// Adds a beam and the lines it meets; the group must not be full.
    void add(const Beam& beam, const LineRange& lines);
    void clear() { size_ = 0; }

    /// Prepares all beams of the group. The functions below are valid only after this call.
    void prepare();
    const Beam& beam(std::size_t i) const { return *beams_[i]; }
    const LineRange& lines(std::size_t i) const { return lines_[i]; }
    /// Returns true if single precision is not accurate enough for this beam.
    bool needs_doubles(std::size_t i) const { return in_plane_.needs_doubles[i] != 0; }
    BeamInPlane in_plane(std::size_t i) const;
    LineFrame frame(std::size_t i) const;

    template <typename Number>
    using Lanes = std::array<Number, most>;
    /// Input and output of the kernel.
    struct Ends {
        Lanes<double> a_along, a_across, a_z, ra, b_along, b_across, b_z, rb, first_line;
    };
    struct InPlane {
        Lanes<float> ux, uy, z, qz, a, inverse_a, cos2, sine, radius, low, high, ax, ay, ah, bx, by, bh;
        Lanes<float> line0, shift;
        Lanes<std::int32_t> first, unit0, needs_doubles;
    };

  private:
    RowBand band_;
    double z_;
    std::size_t size_ = 0;
    Lanes<const Beam*> beams_;
    Lanes<LineRange> lines_;
    Ends ends_{};  // unused lanes are prepared too
    InPlane in_plane_;
};

}  // namespace lamella
