// SurfacePattern: a pattern by example on the surface of a body, through the thickness of its skin.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "procedural/skin/window_pattern.h"
#include "procedural/texture/flat_pattern.h"
#include "procedural/texture/lattice_hash.h"

namespace lamella {

struct SurfacePatternSettings {
    ExampleSettings example;
    std::optional<dvec3> axis{};  ///< of the pattern's y; smooth by itself if not given
    double depth = 1;             ///< distance from the surface within which the pattern is wanted, mm
};

/// Synthesised on sites of the surface, at every depth the pattern of the nearest site. Distances lie in
/// bricks of 8 x 8 x 8 cells, one site's spacing wide, about the surface alone. Immutable.
class SurfacePattern : public WindowPattern {
  public:
    /// The largest number of sites; more are refused.
    static constexpr std::size_t most_sites = 4'000'000;

    /// Throws InputError as sites_on_surface(), make_example() and printable_pattern() do, Interrupted when
    /// cancelled.
    SurfacePattern(const Volume& picture, const Field& body, const SurfacePatternSettings& settings);

    double value_near(dvec3 p, std::uint32_t& hint) const override;

    const PrintablePattern& pattern() const { return pattern_; }
    double wanted_share() const { return wanted_share_; }  ///< the picture's
    double spacing() const { return spacing_; }            ///< of sites, mm
    std::size_t bytes() const { return bricks_.size() * sizeof(Brick); }

  private:
    /// Samples of 8 x 8 x 8 cells with all their corners, so that a cell needs one brick.
    static constexpr int cells = 8, side = cells + 1;
    static constexpr int samples = side * side * side;
    using Brick = std::array<std::int16_t, samples>;

    void fill_bricks(const SurfaceSites& sites, double depth);
    void find_slope();

    double spacing_ = 1, wanted_share_ = 0;
    double unit_ = 1;   ///< mm a step of the samples
    double slope_ = 1;  ///< of the interpolated distances, at most
    PrintablePattern pattern_;
    std::unordered_map<glm::i64vec3, std::uint32_t, LatticeHash>
        places_;                         ///< of bricks, by cell over `cells`
    std::vector<glm::i64vec3> corners_;  ///< by brick, the same
    std::vector<Brick> bricks_;
};

}  // namespace lamella
