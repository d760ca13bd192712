// The slice of a set of wedges: an index of those that meet the plane, and their runs in closed form.
#pragma once

#include <vector>

#include "engine/runs/run_collector.h"
#include "engine/solids/plane_index.h"
#include "engine/solids/round_triangle.h"

namespace lamella {

/// The wedges of one plane, indexed by bands of lines. Round triangles are drawn as the wedges of all and the
/// beams of their edges (BeamRows), where a shared edge is given once.
class WedgeRows {
  public:
    WedgeRows() = default;
    /// Keeps the wedges that may meet the plane at height z, mm.
    WedgeRows(const std::vector<Wedge>& wedges, double z);
    /// The wedges of round triangles; their edges' beams are the caller's.
    WedgeRows(const std::vector<RoundTriangle>& triangles, double z);

    /// Adds the runs of all wedges that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const { collect(band, {0, band.lines()}, runs); }
    /// The same on some of its lines only.
    void collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const;
    /// Encloses the wedges' sections, mm.
    const Rect& bounds() const { return sections_.bounds(); }
    std::size_t size() const { return wedges_.size(); }

  private:
    void collect_wedge(const Wedge& wedge, const RowBand& band, const LineRange& lines,
                       RunCollector& runs) const;

    std::vector<Wedge> wedges_;
    double z_ = 0;
    PlaneIndex sections_;
};

}  // namespace lamella
