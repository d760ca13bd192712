// FlatPattern: a sheet of a pattern by example that tiles the plane.
#pragma once

#include "procedural/pattern/pattern_example.h"

namespace lamella {

/// The solid of a sheet in the plane z = 0 from the origin on, as a field of any height: its value is a bound
/// of the distance from the pattern's border. Immutable.
class FlatPattern : public Field {
  public:
    /// `sheet` is the size, mm: the width is kept, the height rounded to whole sites of the coarsest grid.
    /// Throws InputError as make_example() and printable_pattern() do, for a sheet smaller than the picture
    /// or of too many sites, and Interrupted when cancelled.
    FlatPattern(const Volume& picture, dvec2 sheet, const ExampleSettings& settings);

    double value(dvec3 p) const override;
    Box bounds() const override;

    /// Returns the distance from the border in the plane, mm, positive in the solid, of the sheet that tiles.
    double distance(dvec2 at) const;
    dvec2 size() const { return {width_ * spacing_, height_ * spacing_}; }  ///< mm
    double spacing() const { return spacing_; }                             ///< of sites, mm
    double wanted_share() const { return pattern_.wanted_share; }           ///< the picture's
    const SoundPattern& pattern() const { return pattern_; }

  private:
    int width_ = 0, height_ = 0;  ///< sites
    double spacing_ = 1;
    SoundPattern pattern_;
};

}  // namespace lamella
