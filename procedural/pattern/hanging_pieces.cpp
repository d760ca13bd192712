// Persistence of the components of sublevel sets: pieces are born, and die where they join an older one.
#include "procedural/pattern/hanging_pieces.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "engine/base/disjoint_sets.h"
#include "procedural/pattern/carried_distance.h"
#include "procedural/pattern/nearest_on_lattice.h"

namespace lamella {

HangingPieces::HangingPieces(const SurfaceSites& sites, double depth) : sites_(sites) {
    constexpr std::int64_t side = 8;
    const double spacing = sites.spacing;
    const NearestOnLattice nearest(sites, depth + 2 * spacing, 2 * spacing);
    for (const glm::i64vec3 corner : nearest.bricks()) {
        for (int k = 0; k < side * side * side; ++k) {
            const glm::i64vec3 at = side * corner + glm::i64vec3(k % side, k / side % side, k / side / side);
            const std::uint32_t site = nearest.site(at);
            if (site == NearestOnLattice::none) continue;
            const double height = glm::dot(dvec3(at) * spacing - sites.places[site], sites.normals[site]);
            const double below = std::min(-height, depth + height);
            if (below > -spacing) samples_.push_back({at, site, static_cast<float>(below)});
        }
    }
    std::ranges::sort(samples_, {},
                      [](const Sample& sample) { return std::tuple(sample.at.y, sample.at.x, sample.at.z); });
}

/// Returns the intervals by y, x, and begin.
std::vector<HangingPieces::Interval> HangingPieces::intervals_of(std::span<const float> distances) const {
    const CarriedDistance carried(sites_, distances);
    const double spacing = sites_.spacing;
    std::vector<Interval> intervals;
    glm::i64vec3 last(0);
    double last_value = 0;
    bool is_first = true;
    for (const Sample& sample : samples_) {
        const dvec3 p = dvec3(sample.at) * spacing;
        const double value = std::min(carried.at(p, sample.site), static_cast<double>(sample.depth));
        const bool goes_on = !is_first && sample.at == last + glm::i64vec3(0, 0, 1);
        if (value > 0) {
            const bool is_inside = goes_on && last_value > 0;
            const double into = goes_on ? value / (value - last_value) : 0.5;
            if (!is_inside)
                intervals.push_back({sample.at.x, sample.at.y, p.z - into * spacing, 0, sample.site});
            intervals.back().end = p.z + 0.5 * spacing;
        } else if (goes_on && last_value > 0) {
            intervals.back().end = p.z + value / (last_value - value) * spacing;
        }
        last = sample.at;
        last_value = value;
        is_first = false;
    }
    return intervals;
}

/// Takes intervals by y, x and begin. Looks from each line at the four of its eight neighbours that come
/// before it.
std::vector<HangingPieces::Joint> HangingPieces::joints_of(std::span<const Interval> intervals) {
    constexpr std::array<std::pair<int, int>, 4> before{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    std::array<std::size_t, before.size()> first{};
    std::vector<Joint> joints;
    for (std::uint32_t i = 0; i < intervals.size(); ++i) {
        const Interval& here = intervals[i];
        for (std::size_t k = 0; k < before.size(); ++k) {
            const std::pair line(here.y + before[k].second, here.x + before[k].first);
            const auto line_of = [&](std::size_t j) { return std::pair(intervals[j].y, intervals[j].x); };
            while (line_of(first[k]) < line) ++first[k];
            for (std::size_t j = first[k]; line_of(j) == line; ++j) {
                const double height = std::max(here.begin, intervals[j].begin);
                if (height <= std::min(here.end, intervals[j].end))
                    joints.push_back({height, i, static_cast<std::uint32_t>(j)});
            }
        }
    }
    return joints;
}

std::vector<std::uint32_t> HangingPieces::find(std::span<const float> distances) const {
    const std::vector<Interval> intervals = intervals_of(distances);
    std::vector<Joint> joints = joints_of(intervals);
    std::ranges::sort(joints, {},
                      [](const Joint& joint) { return std::tuple(joint.height, joint.a, joint.b); });
    std::vector<std::uint32_t> by_begin(intervals.size()), rank(intervals.size());
    for (std::uint32_t i = 0; i < by_begin.size(); ++i) by_begin[i] = i;
    std::ranges::sort(by_begin, {}, [&](std::uint32_t i) { return std::pair(intervals[i].begin, i); });
    for (std::uint32_t r = 0; r < by_begin.size(); ++r) rank[by_begin[r]] = r;
    // A set's representative is its lowest rank: the interval with which it began.
    DisjointSets pieces(intervals.size());
    std::vector<double> alone_until(intervals.size(), infinity);
    for (const Joint& joint : joints) {
        const std::uint32_t a = pieces.find(rank[joint.a]), b = pieces.find(rank[joint.b]);
        if (a == b) continue;
        alone_until[std::max(a, b)] = joint.height;
        pieces.join(a, b);
    }
    const double least = 0.25 * sites_.spacing;
    std::vector<std::uint32_t> found;
    for (std::uint32_t r = 0; r < by_begin.size(); ++r) {
        const Interval& interval = intervals[by_begin[r]];
        const bool is_lowest = interval.begin - intervals[by_begin[0]].begin <= least;
        if (!is_lowest && alone_until[r] - interval.begin > least) found.push_back(interval.site);
    }
    return found;
}

}  // namespace lamella
