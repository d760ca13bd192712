// Prism pieces: rectangles and discs of one height, the pillars, bars and feet of scaffolds.
#pragma once

#include <vector>

#include "engine/runs/run_collector.h"
#include "engine/solids/line_frame.h"
#include "engine/solids/plane_index.h"

namespace lamella {

/// A rectangle, or a disc, from one height to another, mm.
struct Prism {
    dvec2 center{0};
    dvec2 direction{1, 0};  ///< of the rectangle's first side, of length 1
    dvec2 half{0};          ///< half its sides; of a disc the radius, twice
    double lo = 0;
    double hi = 0;
    bool round = false;
};

/// Signed distance to the piece's surface, mm; exact.
double signed_distance(const Prism& upright, dvec3 p);
Box bounds(const Prism& upright);

/// The sections of upright pieces in one plane, and their runs.
class UprightRows {
  public:
    /// All of these meet the plane.
    explicit UprightRows(const std::vector<Prism>& uprights);

    /// Adds the runs of all that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const;
    Rect bounds() const { return sections_.bounds(); }

  private:
    std::vector<Prism> uprights_;
    PlaneIndex sections_;
};

}  // namespace lamella
