// NearestFoam: beams from every seed to its k nearest seeds, in a metric that may be stretched and rotated
// from place to place.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "procedural/foam/beam_box.h"
#include "procedural/foam/beam_foam.h"
#include "procedural/foam/foam_settings.h"
#include "procedural/foam/piece_units.h"

namespace lamella {

/// The accepted stretch factors of a k-nearest foam.
inline constexpr Interval nearest_factors{0.1, 10};

struct NearestFoamSettings {
    FoamSettings foam;   ///< without a stretch of its own
    int neighbours = 5;  ///< k, from 1 to 26
    /// Factors along three orthogonal axes, within nearest_factors. Beams along an axis with a larger factor
    /// are more numerous and longer.
    std::array<Graded, 3> stretch = {1.0, 1.0, 1.0};
    std::array<Graded, 3> turn = {0.0, 0.0, 0.0};  ///< rotation of the axes about x, then y, then z, degrees
};

/// The metric at one seed: vectors to other seeds are divided by a factor along each axis.
struct LocalMetric {
    glm::dmat3 inverse{1};      ///< maps a vector to one whose length is its distance in the metric
    double largest_factor = 1;  ///< upper bound of Euclidean length over distance in the metric
    double distance_squared(dvec3 way) const {
        const dvec3 v = inverse * way;
        return v.x * v.x + v.y * v.y + v.z * v.z;
    }
};

/// Makes the beams that a seed owns: those to its k nearest seeds, except to a seed of lower key that has
/// this seed among its own k nearest.
class NearestSource {
  public:
    using Piece = Beam;
    /// `settings` must be valid.
    NearestSource(const FoamSeeding& ground, const NearestFoamSettings& settings, double farthest_ratio);

    void gather(const Box& /*box*/) { known_.clear(); }
    void append(const Seed& own, std::vector<Beam>& beams);
    double reach(const SeedBlock& block, std::size_t node) const;
    double farthest() const;
    double growth(const Box& box) const { return tapered_.radius().largest_in(box); }
    double largest_growth() const { return tapered_.radius().largest(); }
    bool avoids(const Box& /*box*/) const { return false; }
    const Stretch& stretch() const { return turned_; }

    /// Returns the k nearest seeds, by distance, then key.
    const std::vector<Seed>& nearest(const Seed& own);

  private:
    struct Search;
    LocalMetric metric_at(dvec3 p) const;
    double sure_radius(dvec3 p, int deepest_level) const;
    void visit(const SeedBlock& block, std::size_t node, Search& search) const;

    std::shared_ptr<const SeedTree> tree_;
    TaperedBeams tapered_;
    std::size_t neighbours_;
    std::array<Graded, 3> stretch_, turn_;
    double farthest_ratio_;  ///< upper bound of any metric's largest factor over its smallest
    Stretch turned_;
    std::map<SeedKey, std::vector<Seed>> known_;
};

/// A foam of beams between nearby seeds (after Martinez, Song, Dumas and Lefebvre, "Orthotropic k-nearest
/// foams for additive manufacturing", SIGGRAPH 2017). It has no walls and no cells, follows any field of
/// directions, and is not guaranteed to be connected.
class NearestFoam : public BeamFoam {
  public:
    /// Throws InputError for settings out of range.
    explicit NearestFoam(const NearestFoamSettings& settings);

    std::vector<Beam> pieces_touching(const Box& box) const override { return units_.touching(box); }
    /// Returns all seeds in the closed box, in key order.
    std::vector<Seed> seeds_in(const Box& box) const { return ground_.seeds_in(box); }

  private:
    NearestFoam(const NearestFoamSettings& settings, const FoamSeeding& ground);

    FoamSeeding ground_;
    PieceUnits<NearestSource> units_;
};

}  // namespace lamella
