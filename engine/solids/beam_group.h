// A few beams at once, prepared for the row kernel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/solids/beam.h"
#include "engine/solids/line_frame.h"

namespace lamella {

/// Beams as lines along a band's axis meet them. Lanes of doubles, mm; which lines they meet is added up from
/// the band's first one.
class BeamGroup {
  public:
    static constexpr std::size_t most = 8;

    /// Of the plane at height z, mm.
    BeamGroup(const RowBand& band, double z) : band_(band), z_(z) {}

    std::size_t size() const { return size_; }
    bool full() const { return size_ == most; }
    /// There must be room for one.
    void add(const Beam& beam, const LineRange& lines);
    void clear() { size_ = 0; }

    /// Prepares all that were added; what follows is known only then.
    void prepare();
    const Beam& beam(std::size_t i) const { return *beams_[i]; }
    const LineRange& lines(std::size_t i) const { return lines_[i]; }
    /// Whether single precision would not do for it.
    bool needs_doubles(std::size_t i) const { return in_plane_.needs_doubles[i] != 0; }
    BeamInPlane in_plane(std::size_t i) const;
    LineFrame frame(std::size_t i) const;

    template <typename Number>
    using Lanes = std::array<Number, most>;
    /// What is prepared, and from what: for the kernel.
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
    Ends ends_{};  // lanes without a beam are prepared too
    InPlane in_plane_;
};

}  // namespace lamella
