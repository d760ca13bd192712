// PlaneStrips: the slice of a foam, as strips that are filled when a band first needs them.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/solids/beam_slice.h"
#include "engine/solids/wedge_rows.h"

namespace lamella {

/// The pieces that meet a part of a plane.
struct PlanePieces {
    std::vector<Beam> beams;
    std::vector<RoundTriangle> walls;  ///< rasterised without the beams along their edges
};

inline void put_into(PlanePieces& pieces, const Beam& beam) { pieces.beams.push_back(beam); }

/// Runs of infinitely many pieces in one plane. A small plane is one strip; a large one is divided along y
/// into strips of equal height, so that its first band waits only for its own pieces. Thread-safe.
class PlaneStrips : public SampledSlice {
  public:
    /// Returns the pieces that meet the plane within a strip, given by its number and rectangle; may return
    /// more.
    using Query = std::function<PlanePieces(std::size_t strip, const Rect&)>;
    PlaneStrips(const Field& field, Query meeting, const Rect& region, int strips, double z);

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    /// The region's rectangle.
    Rect bounds() const override { return region_; }

  private:
    struct Rows {
        BeamRows beams;
        WedgeRows walls;
    };
    struct Strip {
        std::once_flag opened;
        std::unique_ptr<const Rows> rows;
    };
    const Rows& open(std::size_t strip) const;
    std::size_t strip_of(double y) const;

    Query meeting_;
    Rect region_;
    double z_, height_;
    mutable std::vector<Strip> strips_;
};

}  // namespace lamella
