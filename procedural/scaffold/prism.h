// Prism: an upright box or cylinder, for the pillars, bars and feet of scaffolds.
#pragma once

#include <vector>

#include "engine/runs/run_collector.h"
#include "engine/solids/line_frame.h"
#include "engine/solids/plane_index.h"

namespace lamella {

/// A rectangle or disc extruded from height `lo` to `hi`, mm.
struct Prism {
    dvec2 center{0};
    dvec2 direction{1, 0};  ///< unit vector along the rectangle's first side
    dvec2 half{0};          ///< half the side lengths; for a disc the radius, twice
    double lo = 0;
    double hi = 0;
    bool round = false;
};

/// Returns the exact signed distance to the prism's surface, mm.
double signed_distance(const Prism& upright, dvec3 p);
Box bounds(const Prism& upright);

/// The sections of prisms in one plane, and their runs.
class UprightRows {
  public:
    /// All prisms must meet the plane.
    explicit UprightRows(const std::vector<Prism>& uprights);

    /// Adds the runs of all prisms that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const;
    Rect bounds() const { return sections_.bounds(); }

  private:
    std::vector<Prism> uprights_;
    PlaneIndex sections_;
};

}  // namespace lamella
