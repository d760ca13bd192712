// Slice of a set of beams: an index of the beams that meet the plane, and their runs in closed form.
#pragma once

#include <vector>

#include "engine/field/tile_walk.h"
#include "engine/runs/run_collector.h"
#include "engine/solids/beam.h"
#include "engine/solids/plane_index.h"

namespace lamella {

/// The beams that meet one plane, indexed by the lines they cover. Used by foams, frames, supports and grown
/// meshes.
class BeamRows {
  public:
    BeamRows() = default;
    /// Keeps the beams that meet the plane at height z, mm.
    BeamRows(const std::vector<Beam>& beams, double z);

    /// Adds the runs of all beams that meet the band.
    void collect(const RowBand& band, RunCollector& runs) const { collect(band, {0, band.lines()}, runs); }
    /// Adds them on some of the band's lines only.
    void collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const;
    /// Returns a rectangle that encloses the beams' sections, mm.
    Rect bounds() const { return sections_.bounds(); }
    std::size_t size() const { return beams_.size(); }

  private:
    std::vector<Beam> beams_;
    double z_ = 0;
    PlaneIndex sections_;  ///< where each beam meets the plane
};

/// Slice of a union of beams. Runs come from the beams; samples and ranges from the field.
class BeamSlice : public SampledSlice {
  public:
    /// `beams`: all beams of the field that meet the plane, possibly more.
    BeamSlice(const Field& field, const std::vector<Beam>& beams, double z)
        : SampledSlice(field, z), rows_(beams, z) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Rect bounds() const override { return rows_.bounds(); }

  private:
    BeamRows rows_;
};

}  // namespace lamella
