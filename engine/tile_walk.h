// The tile walk: runs of a field that has no closed form, read off samples where the surface may pass.
#pragma once

#include "engine/field.h"

namespace lamella {

/// Solid runs of a band from range and samples alone. Tiles that `range` proves empty or full are not
/// sampled; elsewhere neighbouring samples are compared, split down to a quarter pitch unless their values
/// prove that no surface passes between them (metric exact or bound), and crossings are bisected to 1/4 of a
/// run unit. A sample that is NaN counts as outside.
void sampled_spans(const SliceField& slice, Metric metric, const RowBand& band, SpanRows& out);

/// The slice of a field that answers from Field::value and Field::range.
class SampledSlice : public SliceField {
  public:
    SampledSlice(const Field& field, double z) : field_(field), z_(z) {}
    void spans(const RowBand& band, Scratch& scratch, SpanRows& out) const override;
    Interval range(const Rect& r) const override;
    void sample(const Tile& tile, std::span<float> out) const override;
    Rect bounds() const override;

  private:
    const Field& field_;
    double z_;
};

}  // namespace lamella
