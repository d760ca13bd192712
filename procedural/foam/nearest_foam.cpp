// Searches the tree for the nearest seeds in a local metric, and makes the beams to them.
#include "procedural/foam/nearest_foam.h"
#include "procedural/voronoi/rounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {
namespace {

/// Returns the octant around the centre that contains the point.
std::size_t octant_about(dvec3 center, dvec3 p) {
    return (p.x >= center.x ? 1U : 0U) | (p.y >= center.y ? 2U : 0U) | (p.z >= center.z ? 4U : 0U);
}

/// Checks the settings. Returns the largest ratio of two factors anywhere in the region.
double check_metric(const NearestFoamSettings& settings) {
    if (settings.neighbours < 1 || settings.neighbours > 26) {
        throw InputError(
            fmt::format("the foam's beams go to {} neighbours; accepted: 1 to 26", settings.neighbours));
    }
    if (!settings.foam.stretch.identity()) {
        throw InputError("a k-nearest foam is stretched by its own factors, not by its seeds");
    }
    Interval all;
    for (const Graded& factor : settings.stretch) {
        const Interval range = tight_range(*factor, settings.foam.region);
        all = {std::min(all.lo, range.lo), std::max(all.hi, range.hi)};
    }
    if (!(all.lo > 0) || !std::isfinite(all.hi)) {
        throw InputError(fmt::format("the foam's stretch reaches {} in the part; accepted: {} to {}",
                                     all.lo > 0 ? all.hi : all.lo, nearest_factors.lo, nearest_factors.hi));
    }
    return std::min(all.hi, nearest_factors.hi) / std::max(all.lo, nearest_factors.lo);
}

NearestFoamSettings within_limits(NearestFoamSettings settings) {
    check_metric(settings);
    for (Graded& factor : settings.stretch) {
        const Interval range = tight_range(*factor, settings.foam.region);
        const auto limited = [](double v) {
            return std::min(std::max(v, nearest_factors.lo), nearest_factors.hi);
        };
        factor = make_clamped_grading(factor.pointer(), {limited(range.lo), limited(range.hi)});
    }
    return settings;
}

}  // namespace

/// A search in progress: the k nearest seeds so far, and the radius within which others may still be nearer.
struct NearestSource::Search {
    struct Found {
        double distance_squared;
        Seed seed;
        bool operator<(const Found& other) const {
            if (distance_squared != other.distance_squared) return distance_squared < other.distance_squared;
            return seed.key < other.seed.key;
        }
    };
    const Seed& own;
    LocalMetric metric;
    std::size_t wanted;
    double radius;             ///< Euclidean; seeds beyond it are not among the k nearest
    std::vector<Found> found;  ///< sorted

    void offer(const Seed& seed) {
        if (seed.key == own.key) return;
        const Found candidate{metric.distance_squared(seed.position - own.position), seed};
        if (found.size() == wanted && !(candidate < found.back())) return;
        found.insert(std::upper_bound(found.begin(), found.end(), candidate), candidate);
        if (found.size() > wanted) found.pop_back();
        if (found.size() < wanted) return;
        radius = std::min(radius,
                          std::sqrt(found.back().distance_squared) * metric.largest_factor * rounding_margin);
    }
};

NearestSource::NearestSource(const FoamSeeding& ground, const NearestFoamSettings& settings,
                             double farthest_ratio)
    : tree_(ground.tree),
      tapered_(ground.radius),
      neighbours_(static_cast<std::size_t>(settings.neighbours)),
      stretch_(settings.stretch),
      turn_(settings.turn),
      farthest_ratio_(farthest_ratio),
      turned_(ground.stretch) {}

LocalMetric NearestSource::metric_at(dvec3 p) const {
    const dvec3 factor(stretch_[0]->at(p), stretch_[1]->at(p), stretch_[2]->at(p));
    dvec3 angle(turn_[0]->at(p), turn_[1]->at(p), turn_[2]->at(p));
    for (int i = 0; i < 3; ++i) angle[i] = std::isfinite(angle[i]) ? angle[i] : 0;
    glm::dmat3 inverse = glm::transpose(turned_axes(angle));
    for (int column = 0; column < 3; ++column) inverse[column] /= factor;
    return {inverse, std::max({factor.x, factor.y, factor.z}) * rounding_margin};
}

/// Returns a radius within which each seed near the point has at least k other seeds: the diagonal of the
/// smallest node around the point with more than k seeds, down to a level.
double NearestSource::sure_radius(dvec3 p, int deepest_level) const {
    const auto block = tree_->block(tree_->block_index(p));
    // Each of the 27 coarse cells around the point has a seed.
    double radius = farthest() / farthest_ratio_;
    const SeedNode* node = &block->nodes[0];
    while (node->seed_count > neighbours_) {
        radius = diagonal(node->box) * rounding_margin;
        if (node->first_child < 0 || node->level == deepest_level) break;
        const dvec3 center = node->box.center();
        node = &block->nodes[static_cast<std::size_t>(node->first_child) + octant_about(center, p)];
    }
    return radius;
}

double NearestSource::reach(const SeedBlock& block, std::size_t node) const {
    const SeedNode& here = block.nodes[node];
    return sure_radius(here.box.center(), here.level) * farthest_ratio_;
}

double NearestSource::farthest() const {
    return 2 * std::sqrt(3.0) * tree_->coarse_side() * rounding_margin * farthest_ratio_;
}

void NearestSource::visit(const SeedBlock& block, std::size_t node, Search& search) const {
    const SeedNode& here = block.nodes[node];
    if (here.seed_count == 0 || distance(here.box, search.own.position) > search.radius) return;
    if (here.first_child < 0) {
        for (std::uint32_t i = here.first_seed; i < here.first_seed + here.seed_count; ++i) {
            search.offer(block.seed(i));
        }
        return;
    }
    // Visit the seed's own octant first, so that the others are pruned sooner.
    const std::size_t first = octant_about(here.box.center(), search.own.position);
    for (std::size_t turn = 0; turn < 8; ++turn) {
        visit(block, static_cast<std::size_t>(here.first_child) + (first ^ turn), search);
    }
}

const std::vector<Seed>& NearestSource::nearest(const Seed& own) {
    const auto [entry, fresh] = known_.try_emplace(own.key);
    if (!fresh) return entry->second;
    // A position on a node's border may have been rounded out of it; twice the radius covers that.
    Search search{
        own, metric_at(own.position), neighbours_, 2 * sure_radius(own.position, -1) * farthest_ratio_, {}};
    const glm::i64vec3 home = tree_->block_index(own.position);
    visit(*tree_->block(home), 0, search);
    const Box about = {own.position - search.radius, own.position + search.radius};
    const glm::i64vec3 lo = tree_->block_index(about.lo), hi = tree_->block_index(about.hi);
    for (std::int64_t z = lo.z; z <= hi.z; ++z) {
        for (std::int64_t y = lo.y; y <= hi.y; ++y) {
            for (std::int64_t x = lo.x; x <= hi.x; ++x) {
                if (glm::i64vec3(x, y, z) == home) continue;
                if (distance(tree_->block_box({x, y, z}), own.position) > search.radius) continue;
                visit(*tree_->block({x, y, z}), 0, search);
            }
        }
    }
    for (const Search::Found& found : search.found) entry->second.push_back(found.seed);
    return entry->second;
}

void NearestSource::append(const Seed& own, std::vector<Beam>& beams) {
    const std::vector<Seed> mine = nearest(own);
    for (const Seed& other : mine) {
        if (other.key < own.key) {
            const auto& theirs = nearest(other);
            const auto is_own = [&](const Seed& seed) { return seed.key == own.key; };
            if (std::any_of(theirs.begin(), theirs.end(), is_own)) continue;
        }
        tapered_.add(turned_.to_part(own.position), turned_.to_part(other.position));
    }
    tapered_.append(beams);
}

NearestFoam::NearestFoam(const NearestFoamSettings& settings)
    : NearestFoam(within_limits(settings), prepare_foam(settings.foam)) {}

NearestFoam::NearestFoam(const NearestFoamSettings& settings, const FoamSeeding& ground)
    : BeamFoam(settings.foam.turned_region(), ground.cell, ground.cells, ground.radius.largest(),
               settings.foam.cache_bytes),
      ground_(ground),
      units_(ground.tree, NearestSource(ground, settings, check_metric(settings)),
             settings.foam.cache_bytes) {}

}  // namespace lamella
