// Synthesis on the surface, then distances carried into the space about it.
#include "procedural/texture/surface_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/texture/body_sites.h"
#include "procedural/texture/carried_distance.h"
#include "procedural/texture/nearest_on_lattice.h"

namespace lamella {

namespace {

constexpr int sweeps_at_the_coarsest = 1000, sweeps_after = 5;
constexpr std::int16_t no_sample = std::numeric_limits<std::int16_t>::min();
constexpr int largest_sample = 16384;

}  // namespace

SurfacePattern::SurfacePattern(const Volume& picture, const Field& body,
                               const SurfacePatternSettings& settings) {
    const Example example = make_example(picture, settings.example);
    const SynthesisSettings& synthesis = settings.example.synthesis;
    wanted_share_ = example.share;
    spacing_ = example.spacing;
    std::vector<PatternLevel> levels;
    for (int halvings = example.levels - 1; halvings >= 0; --halvings) {
        PatternLevel level;
        level.sites = sites_on_surface(body, spacing_ * (1 << halvings), most_sites, synthesis.cancel);
        const bool is_coarsest = levels.empty();
        set_tangents(level.sites, is_coarsest ? nullptr : &levels.back().sites, settings.axis,
                     is_coarsest ? sweeps_at_the_coarsest : sweeps_after);
        level.windows = site_windows(level.sites, synthesis.window);
        levels.push_back(std::move(level));
    }
    const SynthesisResult found =
        synthesise_levels(levels, example.picture, example.width(spacing_, settings.example.size), synthesis);
    const PrintSettings print{.share = example.share,
                              .strut = settings.example.strut,
                              .gap = settings.example.gap,
                              .limit = std::max(settings.example.strut, settings.example.gap)};
    pattern_ = printable_pattern(levels.back().sites, levels.back().windows, found.pattern, print);
    unit_ = print.limit / largest_sample;
    fill_bricks(levels.back().sites, settings.depth);
}

void SurfacePattern::fill_bricks(const SurfaceSites& sites, double depth) {
    const CarriedDistance carried(sites, pattern_.distance);
    const NearestOnLattice nearest(sites, depth + 2 * spacing_);
    corners_ = nearest.bricks();
    bricks_.resize(corners_.size());
    for (std::uint32_t i = 0; i < corners_.size(); ++i) places_.emplace(corners_[i], i);
    const double limit = largest_sample * unit_;
    parallel_for(corners_.size(), [&](std::size_t i) {
        for (int k = 0; k < samples; ++k) {
            const glm::i64vec3 at = std::int64_t{cells} * corners_[i] +
                                    glm::i64vec3(k % side, k / side % side, k / (side * side));
            const std::uint32_t site = nearest.site(at);
            std::int16_t& sample = bricks_[i][static_cast<std::size_t>(k)];
            sample = no_sample;
            if (site == NearestOnLattice::none) continue;
            const double distance = carried.at(dvec3(at) * spacing_, site);
            sample = static_cast<std::int16_t>(std::lround(std::clamp(distance, -limit, limit) / unit_));
        }
    });
    find_slope();
}

/// The interpolated distance is no steeper than the steepest differences along each axis together.
void SurfacePattern::find_slope() {
    std::vector<std::array<int, 3>> steepest(bricks_.size(), {0, 0, 0});
    parallel_for(bricks_.size(), [&](std::size_t i) {
        constexpr std::array<std::size_t, 3> steps{1, side, std::size_t{side} * side};
        for (int k = 0; k < samples; ++k) {
            const std::array<int, 3> at{k % side, k / side % side, k / (side * side)};
            const int here = bricks_[i][static_cast<std::size_t>(k)];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (at[axis] == cells) continue;
                const int next = bricks_[i][static_cast<std::size_t>(k) + steps[axis]];
                if (here != no_sample && next != no_sample)
                    steepest[i][axis] = std::max(steepest[i][axis], std::abs(next - here));
            }
        }
    });
    dvec3 most(0);
    for (const auto& of_brick : steepest)
        most = glm::max(most, dvec3(of_brick[0], of_brick[1], of_brick[2]) * (unit_ / spacing_));
    slope_ = std::max(1.0, std::sqrt(glm::dot(most, most)));
}

double SurfacePattern::value_near(dvec3 p, std::uint32_t& hint) const {
    const dvec3 at = p / spacing_, floor = glm::floor(at), share = at - floor;
    const glm::i64vec3 cell(floor), brick(cell.x >> 3, cell.y >> 3, cell.z >> 3);
    // Away from the surface, the shell alone decides.
    constexpr double solid = -std::numeric_limits<double>::min();
    if (hint >= bricks_.size() || corners_[hint] != brick) {
        const auto found = places_.find(brick);
        if (found == places_.end()) return solid;
        hint = found->second;
    }
    const std::int16_t* const corner =
        &bricks_[hint][static_cast<std::size_t>((cell.x & 7) + side * ((cell.y & 7) + side * (cell.z & 7)))];
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
        const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
        const std::int16_t sample = corner[x + side * (y + side * z)];
        if (sample == no_sample) return solid;
        sum += (x != 0 ? share.x : 1 - share.x) * (y != 0 ? share.y : 1 - share.y) *
               (z != 0 ? share.z : 1 - share.z) * sample;
    }
    return -sum * unit_ / slope_;
}

}  // namespace lamella
