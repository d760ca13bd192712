// The slice of a foam of beams: its plane in strips, each opened when a band first needs it.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/beam_slice.h"

namespace lamella {

/// Runs of infinitely many beams in one plane. A small plane is one strip; a large one is cut across y into
/// strips of equal height, so that its first band waits for its own beams only. Thread-safe.
class BeamStrips : public SampledSlice {
  public:
    /// All beams that touch a box.
    using Query = std::function<std::vector<Beam>(const Box&)>;
    BeamStrips(const Field& field, Query beams_touching, const Rect& region, int strips, double z);

    void spans(const RowBand& band, Scratch& scratch, SpanRows& out) const override;
    /// The region.
    Rect bounds() const override { return region_; }

  private:
    struct Strip {
        std::once_flag opened;
        std::unique_ptr<const BeamRows> rows;
    };
    const BeamRows& open(std::size_t strip) const;
    std::size_t strip_of(double y) const;

    Query beams_touching_;
    Rect region_;
    double z_, height_;
    mutable std::vector<Strip> strips_;
};

}  // namespace lamella
