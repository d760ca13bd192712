// TpmsSlice: the slice of a triply periodic solid, with runs of one period, repeated, if period and
// thickness are constant in its plane.
#pragma once

#include "engine/field/tile_walk.h"
#include "procedural/lattice/tpms_solid.h"
#include "procedural/lattice/wall_plane.h"

namespace lamella {

/// The slice at height z. Runs are clipped to the solid's region. `field` is the field of the solid.
class TpmsSlice : public SampledSlice {
  public:
    TpmsSlice(const Field& field, const TpmsSolid& solid, double z);

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    void sample(const Tile& tile, std::span<float> out) const override;

  private:
    void closed_spans(const RowBand& band, double thickness, RunRows& out) const;
    void walked_spans(const RowBand& band, RunRows& out) const;
    void sample_row(const Tile& tile, int first, std::span<const SineCosine> columns, double y,
                    std::span<float> out) const;

    const TpmsSolid& solid_;
    double z_;
    Rect region_;  ///< empty at heights outside the region
    SineCosine height_;
    std::optional<WallPlane> plane_;   ///< of a sheet with a constant period
    std::optional<double> thickness_;  ///< where it is the same in all of the plane, as is the period, mm
};

}  // namespace lamella
