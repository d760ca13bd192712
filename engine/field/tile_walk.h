// Tile walk: runs of a solid without a closed form, from samples where the surface may pass.
#pragma once

#include <algorithm>

#include "engine/field/tile_sampler.h"

namespace lamella {

/// Bound on how a value changes along a line: f(q) - f(p) lies within slope * (q - p) +- noise for any two
/// points of the line. Unknown by default.
struct SlopeBound {
    Interval slope{-infinity, infinity};  ///< per mm
    double noise = infinity;              ///< rounding error of the values as computed

    bool known() const { return -infinity < slope.lo && slope.hi < infinity && noise < infinity; }
    bool flat() const { return slope.lo == 0 && slope.hi == 0 && noise == 0; }
    /// Returns true if the values surely rise, or surely fall, from any point to one that lies `distance`
    /// further on.
    bool one_way(double distance) const { return noise < std::max(slope.lo, -slope.hi) * distance; }
};

/// A solid in a plane that learns which tile the walk is in, so that it can specialise on it.
class TileSampledSolid : public SampledSolid {
  public:
    /// Enters a tile, which lies in the one entered before; returns an interval that encloses every value
    /// over it. Values are requested within the innermost tile only.
    virtual Interval enter(const Rect& tile) = 0;
    /// Leaves the innermost tile.
    virtual void leave() = 0;
    /// Returns how values change along lines within the innermost tile; called right after `enter`.
    virtual SlopeBound slope(Axis /*lines*/) { return {}; }
};

/// A solid in a plane that works alike everywhere and is fastest in batches: the walk bounds the tiles of the
/// whole band level by level, and samples the remaining ones many at a time.
class BatchSampledSolid : public SampledSolid {
  public:
    /// Computes intervals that enclose every value over each of the tiles.
    virtual void ranges(std::span<const Rect> tiles, std::span<Interval> out) = 0;
    /// Returns Field::deviation over a tile.
    virtual double deviation(const Rect& tile) = 0;
};

/// Computes the solid runs of a band from ranges and values alone. Tiles whose range proves them empty or
/// full are not sampled. Where the slope proves that values rise or fall all along a tile's lines, each line
/// has one crossing at most and only its ends are sampled. Elsewhere neighbouring samples are compared, and
/// halved down to a quarter pitch unless their values prove that no surface passes between them (metric exact
/// or bound, or a small deviation from such). Crossings are narrowed to 1/16 of a run unit. NaN counts as
/// outside. Samples lie at quarter pitches counted from the band's origin, and a proof only replaces samples
/// that would agree with it, so a line's runs do not depend on the division into tiles and bands.
void sampled_spans(TileSampledSolid& solid, Metric metric, const RowBand& band, RunRows& out);
void sampled_spans(BatchSampledSolid& solid, Metric metric, const RowBand& band, RunRows& out);

/// Computes the runs of a slice from its `range` and `sample`.
void sampled_spans(const SliceField& slice, Metric metric, const RowBand& band, RunRows& out);

/// A slice computed from the field's values and ranges.
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
