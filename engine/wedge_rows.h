// The slice of a set of wedges: an index of those that meet the plane, and their runs in closed form.
#pragma once

#include <vector>

#include "engine/plane_index.h"
#include "engine/round_triangle.h"
#include "engine/run_collector.h"

namespace lamella {

/// The wedges of one plane, indexed by bands of lines. Round triangles are drawn as the wedges of all and the
/// beams of their edges (BeamRows), where a shared edge is given once.
class WedgeRows {
  public:
    WedgeRows() = default;
    /// Keeps the wedges that may meet the plane at height z, mm.
    WedgeRows(std::vector<Wedge> wedges, double z);
    /// The wedges of round triangles; their edges' beams are the caller's.
    WedgeRows(const std::vector<RoundTriangle>& triangles, double z);

    /// Adds the runs of all wedges that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const;
    /// Encloses the wedges' sections, mm.
    const Rect& bounds() const { return sections_.bounds(); }
    std::size_t size() const { return wedges_.size(); }

  private:
    std::vector<Wedge> wedges_;
    double z_ = 0;
    PlaneIndex sections_;
};

/// Adds the wedge's runs in the plane at height z, mm, on the lines that `across` meets: it must enclose the
/// wedge's extent across the lines there.
void collect_wedge(const Wedge& wedge, double z, const Interval& across, const RowBand& band,
                   RunCollector& runs);

}  // namespace lamella
