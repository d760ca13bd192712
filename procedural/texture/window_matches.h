// WindowMatches: for the window of each site, the most similar window of an exemplar.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/appearance/window_difference.h"
#include "procedural/texture/texture_synthesis.h"

namespace lamella {

/// The middle pixel of a window of the exemplar.
struct ExemplarPixel {
    std::int16_t x = 0, y = 0;
    bool operator==(const ExemplarPixel&) const = default;
};

/// PatchMatch over sites in Jacobi form: a sweep reads the matches that the sweep before left. Of equal costs
/// the match counts that is the lower pixel of the exemplar, row by row.
class WindowMatches {
  public:
    /// Matches are random at first. Windows and exemplar have to outlive the object. Throws InputError for a
    /// part of the exemplar smaller than a window in a direction, and of more than 1024 pixels.
    WindowMatches(const SiteWindows& windows, const Exemplar& exemplar, int level,
                  const SynthesisSettings& settings);

    /// Replaces the matches by those of patches: parts of the exemplar, as large as a window, side by side.
    void begin_with_patches();
    /// Replaces the matches by pixels of the exemplar, row * width + column. Those with a number other than 0
    /// in `kept` stay as they are.
    void begin_with(std::span<const std::uint32_t> pixels, std::vector<std::uint8_t> kept);
    /// Improves the matches for a pattern by a number of sweeps.
    void sweep(const SitePattern& pattern, int sweeps);

    std::span<const ExemplarPixel> matches() const { return matches_; }
    /// Returns by site the difference to its match, a pixel of the window, without the uniformity term.
    std::span<const float> differences() const { return differences_; }

  private:
    struct Search;
    void take_bytes(const SitePattern& pattern);
    void average_use();
    void improve(std::size_t site, Search& search);
    void consider_neighbours(std::size_t site, Search& search) const;
    void consider_random(std::size_t site, Search& search) const;
    void compare(std::size_t site, Search& search) const;
    /// Returns the pixel of a part nearest to (x, y) about which a window fits.
    ExemplarPixel clamped(int x, int y, std::size_t part) const;
    std::size_t part_of(ExemplarPixel pixel) const { return exemplar_.part_of(pixel.y); }
    std::size_t wanted_part(std::size_t site, double random) const;
    float reluctance(std::size_t site, ExemplarPixel pixel) const;
    void average_use(const ExemplarPart& part, double matches, std::span<const std::int64_t> sums);
    std::size_t window_of(ExemplarPixel pixel) const {
        return static_cast<std::size_t>(pixel.y - radius_) * columns_ +
               static_cast<std::size_t>(pixel.x - radius_);
    }

    const SiteWindows& windows_;
    const Exemplar& exemplar_;
    SynthesisSettings settings_;
    int level_, width_, height_, radius_;
    std::size_t columns_, rows_;  ///< of windows in the exemplar
    WindowDifference difference_;
    std::vector<std::uint8_t> exemplar_solid_, exemplar_distance_;  ///< as WindowDifference::all_rows
    std::vector<std::uint8_t> solid_, distance_;                    ///< of the sites
    std::vector<ExemplarPixel> matches_, next_;
    std::vector<std::uint8_t> kept_;  ///< by site; empty: none
    std::vector<float> differences_;
    std::vector<float>
        use_;  ///< by window of the exemplar: how often over the mean, less 1; its mean over sweeps
    std::uint64_t sweeps_ = 0;
};

}  // namespace lamella
