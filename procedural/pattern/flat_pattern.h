// FlatPattern: a sheet of a pattern by example that tiles the plane.
#pragma once

#include <optional>

#include "engine/field/field.h"
#include "procedural/pattern/pattern_bridges.h"
#include "procedural/pattern/reinforcement.h"
#include "procedural/pattern/sound_pattern.h"
#include "procedural/texture/pattern_levels.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// A picture as the example of a pattern.
struct ExampleSettings {
    double size = 20;                   ///< width of the picture, mm
    double strut = 0.8;                 ///< least width of struts, mm
    double gap = 0;                     ///< least width of gaps, mm; 0: any
    std::optional<double> threshold{};  ///< grey level, 0 to 1; darker is solid; Otsu's if not given
    bool invert = false;                ///< lighter is solid instead
    Reinforcement reinforce = Reinforcement::shape;
    SynthesisSettings synthesis{};
};

/// An example in black and white, and the grid on which its pattern is synthesised.
struct Example {
    GreyImage picture;   ///< black and white, see black_and_white()
    double share = 0;    ///< solid share of the picture
    double spacing = 0;  ///< of sites, mm: four to a strut, but none narrower than a pixel
    int levels = 1;      ///< of grids, each half as wide as the one before

    /// Returns the picture's width in sites that lie `spacing` apart.
    int width(double site_spacing, double size) const;
};

/// Throws InputError for settings out of range, and for a picture of less than three windows of sites.
Example make_example(const Volume& picture, const ExampleSettings& settings);

/// Returns the settings of bridges between sites.
BridgeSettings bridge_settings(const SurfaceSites& sites, const ExampleSettings& settings);

/// Synthesises the example on the sites of all levels, the coarsest first, and makes the pattern printable,
/// with bridges as `choice` says, or without more than join its pieces if that is null. Throws InputError as
/// printable_pattern(), Interrupted when cancelled.
SoundPattern synthesise_example(const Example& example, const std::vector<PatternLevel>& levels,
                                const ExampleSettings& settings, BridgeChoice* choice);
/// The same, with bridges by shape if the settings ask for them. Throws InputError for other reinforcements.
SoundPattern synthesise_example(const Example& example, const std::vector<PatternLevel>& levels,
                                const ExampleSettings& settings);

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
    double wanted_share() const { return wanted_share_; }                   ///< the picture's
    const SoundPattern& pattern() const { return pattern_; }

  private:
    int width_ = 0, height_ = 0;  ///< sites
    double spacing_ = 1, wanted_share_ = 0;
    SoundPattern pattern_;
};

}  // namespace lamella
