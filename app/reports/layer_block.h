// LayerBlock: a block of printed layers as a solid, for pictures from the side.
#pragma once

#include <vector>

#include "app/reports/run_coverage.h"

namespace lamella {

/// A stack of layers in a box; outside the box is void. The surface is where half of a pixel is covered.
/// Values have the right sign everywhere, but approximate distances only within a pixel of the surface.
/// Evaluation is cheap, whatever the layers were made from.
class LayerBlock : public Field {
  public:
    /// Layers are ordered from the lower side of the box up; each covers the box's rectangle.
    LayerBlock(const Box& box, std::vector<RunCoverage> layers);

    double value(dvec3 p) const override;
    const SliceField& slice(SliceContext& context, double z) const override;
    Box bounds() const override { return box_; }
    /// Appends the solid intervals of a line in a plane, mm; see ClosedSlice.
    void cut(Axis axis, double across, double z, std::vector<Interval>& intervals) const;

  private:
    /// Returns the interpolated share of material at a point, 0 to 1.
    double share(dvec3 p) const;
    double share_in(int layer, dvec2 at) const;

    Box box_;
    std::vector<RunCoverage> layers_;
    double height_;  ///< of a layer, mm
    double pixel_;   ///< mm
};

}  // namespace lamella
