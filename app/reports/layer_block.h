// A block of printed layers as a solid: what a picture from the side is drawn of.
#pragma once

#include <vector>

#include "app/reports/run_coverage.h"

namespace lamella {

/// Layers on top of each other in a box, each as high as it is. What lies outside the box is void. The
/// surface is where half of a pixel is covered, and values say which side of it a point is on; they are
/// distances only nearer to it than a pixel. Cheap to ask, whatever the layers were made from.
class LayerBlock : public Field {
  public:
    /// Layers from the lower side of the box up, their rectangles the box's.
    LayerBlock(const Box& box, std::vector<RunCoverage> layers);

    double value(dvec3 p) const override;
    const SliceField& slice(SliceContext& context, double z) const override;
    Box bounds() const override { return box_; }
    /// Appends where a line of a plane is solid, mm; see ClosedSlice.
    void cut(Axis axis, double across, double z, std::vector<Interval>& intervals) const;

  private:
    /// Share of material about a point, 0 to 1.
    double share(dvec3 p) const;
    double share_in(int layer, dvec2 at) const;

    Box box_;
    std::vector<RunCoverage> layers_;
    double height_;  ///< of a layer, mm
    double pixel_;   ///< mm
};

}  // namespace lamella
