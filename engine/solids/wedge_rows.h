// Slice of a set of wedges: an index of the wedges that meet the plane, and their runs in closed form.
#pragma once

#include <vector>

#include "engine/runs/run_collector.h"
#include "engine/solids/plane_index.h"
#include "engine/solids/round_triangle.h"

namespace lamella {

/// The wedges that meet one plane, indexed by the lines they cover. A round triangle is drawn as its wedge
/// plus the beams of its edges (BeamRows); a shared edge is added once.
class WedgeRows {
  public:
    WedgeRows() = default;
    /// Keeps the wedges that may meet the plane at height z, mm.
    WedgeRows(const std::vector<Wedge>& wedges, double z);
    /// Keeps the wedges of round triangles; the caller draws the beams of their edges.
    WedgeRows(const std::vector<RoundTriangle>& triangles, double z);

    /// Adds the runs of all wedges that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const { collect(band, {0, band.lines()}, runs); }
    /// Adds them on some of the band's lines only.
    void collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const;
    /// Returns a rectangle that encloses the wedges' sections, mm.
    const Rect& bounds() const { return sections_.bounds(); }
    std::size_t size() const { return wedges_.size(); }

  private:
    void collect_wedge(std::uint32_t number, const RowBand& band, const LineRange& lines,
                       RunCollector& runs) const;

    std::vector<Wedge> wedges_;  ///< their sides stand outside of the triangles' edges, see side_slack
    double z_ = 0;
    PlaneIndex sections_;
};

}  // namespace lamella
