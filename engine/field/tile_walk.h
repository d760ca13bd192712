// The tile walk: runs of a solid that has no closed form, read off samples where the surface may pass.
#pragma once

#include <algorithm>

#include "engine/field/tile_sampler.h"

namespace lamella {

/// How a value may change along a line: f(q) - f(p) lies within slope * (q - p) +- noise for any two points
/// of the line. Unknown unless told.
struct SlopeBound {
    Interval slope{-infinity, infinity};  ///< per mm
    double noise = infinity;              ///< of the values as computed

    bool known() const { return -infinity < slope.lo && slope.hi < infinity && noise < infinity; }
    bool flat() const { return slope.lo == 0 && slope.hi == 0 && noise == 0; }
    /// The values surely rise, or surely fall, from any point to one that lies `distance` on.
    bool one_way(double distance) const { return noise < std::max(slope.lo, -slope.hi) * distance; }
};

/// A solid in a plane that is told which tile the walk is in, so that it may narrow what it works with.
class TileSampledSolid : public SampledSolid {
  public:
    /// The walk goes down into a tile, which lies in the one before: encloses every value over it. Values
    /// are asked for within the innermost tile only.
    virtual Interval enter(const Rect& tile) = 0;
    /// The walk leaves the innermost tile.
    virtual void leave() = 0;
    /// How values change along lines within the innermost tile; asked for right after `enter`.
    virtual SlopeBound slope(Axis /*lines*/) { return {}; }
};

/// A solid in a plane that works with the same all over it, and is quickest when asked about much at once:
/// the walk looks at the tiles of all of the band level by level, and samples what is left many at a time.
class BatchSampledSolid : public SampledSolid {
  public:
    /// Encloses every value over each of the tiles.
    virtual void ranges(std::span<const Rect> tiles, std::span<Interval> out) = 0;
};

/// Solid runs of a band from ranges and values alone. Tiles whose range proves them empty or full are not
/// sampled. Where the slope proves that values rise or fall all along a tile's lines, so that each has one
/// crossing at most, their ends are. Elsewhere neighbouring samples are compared, split down to a quarter
/// pitch unless their values prove that no surface passes between them (metric exact or bound). Crossings are
/// narrowed to 1/16 of a run unit. A value that is NaN counts as outside. Samples lie at quarter pitches
/// counted from the band's origin, and what is proven is what they would tell, so a line's runs do not depend
/// on how it is cut into tiles and bands.
void sampled_spans(TileSampledSolid& solid, Metric metric, const RowBand& band, RunRows& out);
void sampled_spans(BatchSampledSolid& solid, Metric metric, const RowBand& band, RunRows& out);

/// The same for a slice that answers from range and sample.
void sampled_spans(const SliceField& slice, Metric metric, const RowBand& band, RunRows& out);

/// The slice of a field that answers from its values and ranges.
class SampledSlice : public SliceField {
  public:
    SampledSlice(const Field& field, double z) : field_(field), z_(z) {}
    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Interval range(const Rect& r) const override;
    void sample(const Tile& tile, std::span<float> out) const override;
    Rect bounds() const override;

  private:
    const Field& field_;
    double z_;
};

}  // namespace lamella
