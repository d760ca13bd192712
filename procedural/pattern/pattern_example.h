// Pictures as the examples of a pattern, and the pattern they give on sites.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/field/grading.h"
#include "procedural/pattern/pattern_bridges.h"
#include "procedural/pattern/reinforcement.h"
#include "procedural/pattern/sound_pattern.h"
#include "procedural/texture/pattern_levels.h"
#include "procedural/volume/volume.h"

namespace lamella {

/// A second picture, into which a pattern changes; both null, or none.
struct SecondPicture {
    std::shared_ptr<const Volume> picture;
    GradingPtr weight;  ///< 0 where the pattern looks like the first, 1 where like the second
};

/// What a pattern is to look like, and its least widths.
struct ExampleSettings {
    double size = 20;                   ///< width of the pictures, mm; if it is graded, the largest
    double least_size = 0;              ///< if it is graded, the smallest, mm
    GradingPtr graded_size{};           ///< width by place, mm; null: `size` everywhere
    SecondPicture second{};             ///< none by default
    double strut = 0.8;                 ///< least width of struts, mm
    double gap = 0;                     ///< least width of gaps, mm; 0: any
    std::optional<double> threshold{};  ///< grey level, 0 to 1; darker is solid; Otsu's if not given
    bool invert = false;                ///< lighter is solid instead
    Reinforcement reinforce = Reinforcement::shape;
    SynthesisSettings synthesis{};
};

/// Pictures in black and white, and the grid on which their pattern is synthesised.
struct Example {
    std::vector<GreyImage> pictures;  ///< one or two, see black_and_white()
    std::vector<double> sizes;        ///< widths of the versions of each picture, mm, the largest first
    double spacing = 0;               ///< of sites, mm: four to a strut, but none narrower than a pixel
    int levels = 1;                   ///< of grids, each half as wide as the one before

    /// Returns the exemplar for sites, whose spacing is that of the last level doubled so many times: with a
    /// part for each picture and size, picture by picture.
    Exemplar exemplar(const SurfaceSites& sites, int doublings, const ExampleSettings& settings) const;
    /// Returns the solid share that the pictures have where sites want each as much as an exemplar says.
    double share(const Exemplar& exemplar) const;
};

/// The least width and height of a picture, in windows of sites.
inline constexpr int windows_in_an_example = 3;

/// Throws InputError for settings out of range, and for a picture of less than three windows of sites.
/// Pictures of a graded size have versions a fifth apart, at most 8.
Example make_example(const Volume& picture, const ExampleSettings& settings);

/// Returns the settings of bridges between sites.
BridgeSettings bridge_settings(const SurfaceSites& sites, const ExampleSettings& settings);

/// Synthesises the example on the sites of all levels, the coarsest first, and makes the pattern printable,
/// with bridges as `choice` says, or without more than join its pieces if that is null. Throws InputError as
/// printable_pattern(), Interrupted when cancelled.
SoundPattern synthesise_example(const Example& example, const std::vector<PatternLevel>& levels,
                                const ExampleSettings& settings, BridgeChoice* choice);

}  // namespace lamella
