// Persistence of the components of sublevel sets: pieces are born, and die where they join an older one.
#include "procedural/pattern/hanging_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/base/disjoint_sets.h"
#include "engine/base/parallel.h"
#include "procedural/pattern/nearest_on_lattice.h"

namespace lamella {

namespace {

constexpr std::tuple<std::int64_t, std::int64_t, std::int64_t> by_line(glm::i64vec3 at) {
    return {at.y, at.x, at.z};
}

/// True where a point outside, beyond a convex edge, is merely below the plane of its nearest site.
bool is_beyond_edge(const SurfaceSites& sites, const Field& body, dvec3 p, double height,
                    std::uint32_t site) {
    const dvec3 foot = p - height * sites.normals[site];
    return glm::distance(foot, sites.places[site]) > sites.spacing && body.value(p) > 0;
}

}  // namespace

HangingPieces::HangingPieces(const SurfaceSites& sites, const Field& body, double depth) : sites_(sites) {
    constexpr std::int64_t side = 8;
    const double spacing = sites.spacing;
    const NearestOnLattice nearest(sites, depth + 2 * spacing, 2 * spacing);
    for (const glm::i64vec3 corner : nearest.bricks()) {
        for (int k = 0; k < side * side * side; ++k) {
            const glm::i64vec3 at = side * corner + glm::i64vec3(k % side, k / side % side, k / side / side);
            const std::uint32_t site = nearest.site(at);
            if (site == NearestOnLattice::none) continue;
            const dvec3 p = dvec3(at) * spacing;
            const double height = glm::dot(p - sites.places[site], sites.normals[site]);
            const double below = std::min(-height, depth + height);
            if (below > -spacing && !is_beyond_edge(sites, body, p, height, site))
                samples_.push_back({at, site, static_cast<float>(below)});
        }
    }
    std::ranges::sort(samples_, {}, [](const Sample& sample) { return by_line(sample.at); });
}

/// Returns null where there is none.
const HangingPieces::Sample* HangingPieces::sample_at(glm::i64vec3 at) const {
    const auto found = std::ranges::lower_bound(samples_, by_line(at), {},
                                                [](const Sample& sample) { return by_line(sample.at); });
    return found != samples_.end() && found->at == at ? &*found : nullptr;
}

/// Positive in the solid.
double HangingPieces::value(const CarriedDistance& pattern, const Sample& sample) const {
    return std::min(pattern.at(dvec3(sample.at) * sites_.spacing, sample.site),
                    static_cast<double>(sample.depth));
}

/// Returns the intervals by y, x, and begin.
std::vector<HangingPieces::Interval> HangingPieces::intervals_of(const CarriedDistance& pattern) const {
    const double spacing = sites_.spacing;
    std::vector<Interval> intervals;
    glm::i64vec3 last(0);
    double last_value = 0;
    bool is_first = true;
    for (std::uint32_t i = 0; i < samples_.size(); ++i) {
        const Sample& sample = samples_[i];
        const dvec3 p = dvec3(sample.at) * spacing;
        const double value = this->value(pattern, sample);
        const bool goes_on = !is_first && sample.at == last + glm::i64vec3(0, 0, 1);
        if (value > 0) {
            const bool is_inside = goes_on && last_value > 0;
            const double into = goes_on ? value / (value - last_value) : std::min(value / spacing, 1.0);
            if (!is_inside) intervals.push_back({sample.at.x, sample.at.y, p.z - into * spacing, 0, i});
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
std::vector<HangingPieces::Joint> HangingPieces::neighbours_of(std::span<const Interval> intervals) {
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
                const double height = std::max(here.begin, intervals[j].begin),
                             end = std::min(here.end, intervals[j].end);
                if (height <= end) joints.push_back({height, end, i, static_cast<std::uint32_t>(j)});
            }
        }
    }
    return joints;
}

/// Whether no gap of the pattern lies between two lines at a height: lines see gaps only that are wider than
/// they are apart.
bool HangingPieces::is_solid_between(const CarriedDistance& pattern, const Interval& a, const Interval& b,
                                     double height) const {
    const double spacing = sites_.spacing;
    const auto site_at = [&](const Interval& interval) {
        const auto steps =
            static_cast<std::int64_t>(std::ceil(height / spacing - 0.5)) - samples_[interval.sample].at.z;
        return samples_[interval.sample + static_cast<std::uint32_t>(std::max<std::int64_t>(steps, 0))].site;
    };
    const dvec3 from(spacing * dvec2(a.x, a.y), height), to(spacing * dvec2(b.x, b.y), height);
    constexpr int parts = 4;
    for (int k = 1; k < parts; ++k) {
        const double share = static_cast<double>(k) / parts;
        if (!(pattern.at(glm::mix(from, to, share), site_at(2 * k <= parts ? a : b)) > 0)) return false;
    }
    return true;
}

/// Returns the neighbours without a gap between them, and from which height on.
std::vector<HangingPieces::Joint> HangingPieces::joints_of(const CarriedDistance& pattern,
                                                           std::span<const Interval> intervals) const {
    std::vector<Joint> joints = neighbours_of(intervals);
    const double step = 0.25 * sites_.spacing;
    parallel_for(joints.size(), [&](std::size_t i) {
        Joint& joint = joints[i];
        while (joint.height <= joint.end &&
               !is_solid_between(pattern, intervals[joint.a], intervals[joint.b], joint.height))
            joint.height += step;
    });
    std::erase_if(joints, [](const Joint& joint) { return joint.height > joint.end; });
    return joints;
}

std::vector<std::uint32_t> HangingPieces::find(const CarriedDistance& pattern) const {
    const std::vector<Interval> intervals = intervals_of(pattern);
    std::vector<Joint> joints = joints_of(pattern, intervals);
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
    const double least = 0.25 * sites_.spacing, on_the_bed = 0.02 * sites_.spacing;
    std::vector<std::uint32_t> found;
    for (std::uint32_t r = 0; r < by_begin.size(); ++r) {
        const Interval& interval = intervals[by_begin[r]];
        const bool is_lowest = interval.begin - intervals[by_begin[0]].begin <= on_the_bed;
        if (!is_lowest && alone_until[r] - interval.begin > least) found.push_back(interval.sample);
    }
    return found;
}

/// Returns the height at which the solid that holds a solid sample begins on its line, mm.
double HangingPieces::begin_of(const CarriedDistance& pattern, std::uint32_t sample) const {
    const double spacing = sites_.spacing;
    for (std::uint32_t i = sample;; --i) {
        const glm::i64vec3 at = samples_[i].at;
        const double here = value(pattern, samples_[i]), z = static_cast<double>(at.z) * spacing;
        const bool goes_on = i > 0 && samples_[i - 1].at == at - glm::i64vec3(0, 0, 1);
        if (!goes_on) return z - std::min(here, spacing);
        const double below = value(pattern, samples_[i - 1]);
        if (!(below > 0)) return z - here / (here - below) * spacing;
    }
}

std::vector<std::uint32_t> HangingPieces::way_down(const CarriedDistance& pattern,
                                                   std::uint32_t sample) const {
    const std::int64_t top = samples_[sample].at.z;
    std::vector<std::uint32_t> way = way_to(pattern, sample, [&](const Sample& at) { return at.at.z < top; });
    if (!way.empty()) return way;
    const double begin = begin_of(pattern, sample);
    return way_to(pattern, sample, [&](const Sample& at) {
        return begin_of(pattern, static_cast<std::uint32_t>(&at - samples_.data())) < begin;
    });
}

/// Returns the sites along the cheapest way from a sample to a solid one that is a target.
template <typename IsTarget>
std::vector<std::uint32_t> HangingPieces::way_to(const CarriedDistance& pattern, std::uint32_t sample,
                                                 const IsTarget& is_target) const {
    constexpr std::int64_t most_rise = 2;
    constexpr double rising = 10, above = 100;  // steps that a step up, and one above the sample, are worth
    struct Reached {
        double cost;
        std::uint32_t sample, from;
        bool operator>(const Reached& other) const {
            return std::tie(cost, sample, from) > std::tie(other.cost, other.sample, other.from);
        }
    };
    const std::int64_t top = samples_[sample].at.z;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
    std::unordered_map<std::uint32_t, std::uint32_t> from;
    open.push({0, sample, sample});
    while (!open.empty()) {
        const Reached here = open.top();
        open.pop();
        if (!from.emplace(here.sample, here.from).second) continue;
        const Sample& at = samples_[here.sample];
        if (value(pattern, at) > 0 && is_target(at)) return strut_along(pattern, from, here.sample);
        for (int k = 0; k < 27; ++k) {
            const glm::i64vec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            const std::int64_t z = at.at.z + step.z;
            const Sample* next = z <= top + most_rise ? sample_at(at.at + step) : nullptr;
            if (next == nullptr || next->depth < 0) continue;
            const double cost =
                here.cost + glm::length(dvec3(step)) + (step.z > 0 ? rising : 0) + (z > top ? above : 0);
            open.push({cost, static_cast<std::uint32_t>(next - samples_.data()), here.sample});
        }
    }
    return {};
}

/// Returns the sites along the way to a sample; none if all of the way is solid.
std::vector<std::uint32_t> HangingPieces::strut_along(
    const CarriedDistance& pattern, const std::unordered_map<std::uint32_t, std::uint32_t>& from,
    std::uint32_t end) const {
    std::vector<std::uint32_t> way;
    bool is_over_void = false;
    for (std::uint32_t at = end;; at = from.at(at)) {
        if (way.empty() || way.back() != site(at)) way.push_back(site(at));
        is_over_void |= !(value(pattern, samples_[at]) > 0);
        if (from.at(at) == at) break;
    }
    if (!is_over_void) return {};
    std::ranges::reverse(way);
    return way;
}

}  // namespace lamella
