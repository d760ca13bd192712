// The slice of a set of beams: an index of the beams that meet the plane, and their runs in closed form.
#pragma once

#include <vector>

#include "engine/field/tile_walk.h"
#include "engine/runs/run_collector.h"
#include "engine/solids/beam.h"
#include "engine/solids/plane_index.h"

namespace lamella {

/// The beams of one plane, indexed by bands of lines; shared by foams, frames, supports and grown meshes.
class BeamRows {
  public:
    BeamRows() = default;
    /// Keeps the beams that meet the plane at height z, mm.
    BeamRows(const std::vector<Beam>& beams, double z);

    /// Adds the runs of all beams that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const { collect(band, {0, band.lines()}, runs); }
    /// The same on some of its lines only.
    void collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const;
    /// Encloses the beams' sections, mm.
    Rect bounds() const { return sections_.bounds(); }
    std::size_t size() const { return beams_.size(); }

  private:
    std::vector<Beam> beams_;
    double z_ = 0;
    PlaneIndex sections_;  ///< where each beam meets the plane
};

/// Spans of a field that is a union of beams; samples and ranges by the field itself.
class BeamSlice : public SampledSlice {
  public:
    /// beams: at least all beams of the field that meet the plane.
    BeamSlice(const Field& field, const std::vector<Beam>& beams, double z)
        : SampledSlice(field, z), rows_(beams, z) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Rect bounds() const override { return rows_.bounds(); }

  private:
    BeamRows rows_;
};

}  // namespace lamella
