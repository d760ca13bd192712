// SurfacePattern: a pattern by example on the surface of a body, through the thickness of its skin.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "procedural/pattern/pattern_example.h"
#include "procedural/pattern/skin_loads.h"
#include "procedural/skin/window_pattern.h"
#include "procedural/texture/lattice_hash.h"

namespace lamella {

struct SurfacePatternSettings {
    ExampleSettings example;
    std::optional<dvec3> axis{};   ///< of the pattern's y; smooth by itself if not given
    double depth = 1;              ///< below the surface, down to which the pattern is wanted, mm
    bool self_supporting = false;  ///< struts go down from where the pattern would begin in the air
    /// Of reinforcement by forces, which needs both: the skin without the pattern, and what loads it.
    FieldPtr shell{};
    SkinLoads loads = squeezed_skin;
};

/// Samples of 8 x 8 x 8 cells with all their corners, so that a cell needs one brick. Steps of a distance,
/// positive in the solid; no_sample away from the surface.
struct PatternBrick {
    static constexpr int cells = 8, side = cells + 1, samples = side * side * side;
    static constexpr std::int16_t no_sample = std::numeric_limits<std::int16_t>::min();
    glm::i64vec3 corner{0};  ///< its lowest cell, over `cells`
    std::array<std::int16_t, samples> steps{};
};

/// A pattern by example about a surface: what a plan keeps of it.
struct SurfaceBricks {
    double spacing = 1;       ///< of sites and samples, mm
    double unit = 1;          ///< mm a step
    double slope = 1;         ///< of the interpolated distances, at most: 1 or more
    double share = 0;         ///< of the surface that is solid
    double wanted_share = 0;  ///< the picture's
    /// As in SoundPattern.
    std::uint64_t pieces = 0, joins = 0, bridges = 0, cut_struts = 0, detours = 0, hanging = 0;
    std::uint64_t dropped = 0;  ///< as in PrintablePattern, and crumbs below the surface
    /// Mean compliance under the loads, over that of the closed skin, with bridges by shape alone, and with
    /// all; 0 where no forces were asked for.
    double softness_before = 0, softness = 0;
    std::vector<PatternBrick> bricks{};

    std::size_t bytes() const { return bricks.size() * sizeof(PatternBrick); }
};

/// The largest number of sites; more are refused.
inline constexpr std::size_t most_pattern_sites = 4'000'000;

/// Returns the grids of sites on the body's surface, with windows, the coarsest first. Throws InputError as
/// sites_on_surface(), Interrupted when cancelled.
std::vector<PatternLevel> levels_on(const Field& body, const Example& example,
                                    const SurfacePatternSettings& settings);

/// Synthesises a pattern on sites of the body's surface; at every depth it is that of the nearest site. The
/// same on any number of threads. Throws InputError as sites_on_surface(), make_example() and
/// printable_pattern() do, Interrupted when cancelled.
SurfaceBricks synthesise_on_surface(const Volume& picture, const Field& body,
                                    const SurfacePatternSettings& settings);

/// The pattern as a field. Immutable.
class SurfacePattern : public WindowPattern {
  public:
    explicit SurfacePattern(SurfaceBricks bricks);

    double value_near(dvec3 p, std::uint32_t& hint) const override;
    /// The sign stays to the end of a cell whose corners have one sign, and else as far as the corners'
    /// differences allow.
    Stretch stretch_near(dvec3 p, int axis, bool ascending, std::uint32_t& hint) const override;
    const SurfaceBricks& bricks() const { return bricks_; }

  private:
    const PatternBrick* brick_of(glm::i64vec3 cell, std::uint32_t& hint) const;

    SurfaceBricks bricks_;
    std::unordered_map<glm::i64vec3, std::uint32_t, LatticeHash> places_;  ///< of bricks, by their corner
};

}  // namespace lamella
