// Pairs by a lattice of cubes, overlaps by samples, pieces by union-find.
#include "procedural/elements/element_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "engine/base/disjoint_sets.h"
#include "engine/base/parallel.h"
#include "procedural/texture/lattice_hash.h"

namespace lamella {

namespace {

double distance_of(const PlacedElement& element, std::span<const ElementShapePtr> shapes, dvec3 p,
                   bool is_flat) {
    dvec3 local = element.local(p);
    if (is_flat) local.z = 0;
    return element.scale * shapes[element.shape]->distance(local);
}

double reach_of(const PlacedElement& element, std::span<const ElementShapePtr> shapes) {
    const Box box = shapes[element.shape]->bounds();
    return element.scale * length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
}

/// Pairs of elements whose balls come within a distance of each other, by number.
std::vector<std::pair<std::uint32_t, std::uint32_t>> near_pairs(std::span<const PlacedElement> elements,
                                                                std::span<const ElementShapePtr> shapes,
                                                                double distance) {
    double largest = 0;
    for (const PlacedElement& element : elements) largest = std::max(largest, reach_of(element, shapes));
    const double side = 2 * largest + distance;
    std::unordered_multimap<glm::i64vec3, std::uint32_t, LatticeHash> cubes;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t k = 0; k < elements.size(); ++k) {
        const glm::i64vec3 cube(glm::floor(elements[k].at / side));
        for (int n = 0; n < 27; ++n) {
            const auto [begin, end] =
                cubes.equal_range(cube + glm::i64vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            for (auto other = begin; other != end; ++other) {
                const double apart = length(elements[k].at - elements[other->second].at);
                if (apart <=
                    reach_of(elements[k], shapes) + reach_of(elements[other->second], shapes) + distance)
                    pairs.emplace_back(other->second, k);
            }
        }
        cubes.emplace(cube, k);
    }
    std::ranges::sort(pairs);
    return pairs;
}

/// Elements, which of them hold together, and how far apart the others are.
class Pieces {
  public:
    Pieces(std::vector<PlacedElement> elements, std::span<const ElementShapePtr> shapes,
           const JoinSettings& settings)
        : elements_(std::move(elements)), shapes_(shapes), settings_(settings) {}

    /// Returns the representative of the piece of each element, and then of each solid.
    std::vector<std::uint32_t> pieces() {
        measure_overlaps();
        const auto count = static_cast<std::uint32_t>(elements_.size());
        DisjointSets sets(count + settings_.solids);
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            if (overlaps_[i].depth >= settings_.hold) sets.join(pairs_[i].first, pairs_[i].second);
        }
        for (const Touch& touch : settings_.touches) sets.join(touch.element, count + touch.solid);
        std::vector<std::uint32_t> piece;
        for (std::uint32_t k = 0; k < sets.size(); ++k) piece.push_back(sets.find(k));
        return piece;
    }
    std::optional<std::size_t> narrowest_gap(std::span<const std::uint32_t> piece, std::uint32_t main,
                                             std::span<const std::uint8_t> stays) const;
    /// Moves the piece that is not the main one until both hold together; returns the number of elements.
    std::size_t close(std::size_t pair, std::span<const std::uint32_t> piece, std::uint32_t main);
    /// Joins pieces that carry something by bridges over the narrowest gaps, and changes `piece`. Returns the
    /// bridges, each with one of its two elements.
    std::vector<std::pair<std::uint32_t, ElementBridge>> bridge(std::vector<std::uint32_t>& piece,
                                                                std::span<const std::uint8_t> is_idle) const;
    const std::vector<PlacedElement>& elements() const { return elements_; }

  private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    void measure_overlaps();
    dvec3 outward(std::uint32_t element, dvec3 at) const;

    std::vector<PlacedElement> elements_, measured_;  ///< now, and when overlaps were measured
    std::span<const ElementShapePtr> shapes_;
    const JoinSettings& settings_;
    std::vector<Pair> pairs_;  ///< ascending
    std::vector<Overlap> overlaps_;
};

/// Measures the overlaps of all pairs that are near each other, anew where an element has moved since.
void Pieces::measure_overlaps() {
    std::vector<Pair> pairs = near_pairs(elements_, shapes_, settings_.reach);
    std::vector<Overlap> overlaps(pairs.size());
    parallel_for(pairs.size(), [&](std::size_t i) {
        const auto [a, b] = pairs[i];
        const auto known = std::ranges::lower_bound(pairs_, pairs[i]);
        const bool is_known = known != pairs_.end() && *known == pairs[i] && elements_[a] == measured_[a] &&
                              elements_[b] == measured_[b];
        if (is_known) {
            overlaps[i] = overlaps_[static_cast<std::size_t>(known - pairs_.begin())];
            return;
        }
        overlaps[i] = overlap_of(elements_[a], elements_[b], shapes_, settings_.reach, settings_.is_flat,
                                 settings_.body);
        const bool is_near = overlaps[i].depth >= -0.5 * settings_.reach;
        if (is_near && settings_.may_hold && !settings_.may_hold(elements_[a], elements_[b], overlaps[i].at))
            overlaps[i] = {};
    });
    pairs_ = std::move(pairs);
    overlaps_ = std::move(overlaps);
    measured_ = elements_;
}

/// Returns the pair of an element of the main piece and one of another, which does not stay where it is, that
/// are nearest; none out of reach.
std::optional<std::size_t> Pieces::narrowest_gap(std::span<const std::uint32_t> piece, std::uint32_t main,
                                                 std::span<const std::uint8_t> stays) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const auto [a, b] = pairs_[i];
        const bool is_between = (piece[a] == main) != (piece[b] == main);
        if (!is_between || stays[piece[a] == main ? b : a] != 0) continue;
        if (-2 * overlaps_[i].depth > settings_.reach) continue;
        if (!best || overlaps_[i].depth > overlaps_[*best].depth) best = i;
    }
    return best;
}

/// Returns the direction in which the distance of an element grows at a point, a unit vector.
dvec3 Pieces::outward(std::uint32_t element, dvec3 at) const {
    const double step = 1e-3 * reach_of(elements_[element], shapes_);
    dvec3 slope(0);
    for (int axis = 0; axis < (settings_.is_flat ? 2 : 3); ++axis) {
        dvec3 aside(0);
        aside[axis] = step;
        slope[axis] = distance_of(elements_[element], shapes_, at + aside, settings_.is_flat) -
                      distance_of(elements_[element], shapes_, at - aside, settings_.is_flat);
    }
    const double steep = length(slope);
    return steep > 0 ? slope / steep : dvec3(1, 0, 0);
}

std::vector<std::pair<std::uint32_t, ElementBridge>> Pieces::bridge(
    std::vector<std::uint32_t>& piece, std::span<const std::uint8_t> is_idle) const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const auto [a, b] = pairs_[i];
        const bool is_narrow = -2 * overlaps_[i].depth <= settings_.reach;
        if (is_narrow && is_idle[a] == 0 && is_idle[b] == 0 && piece[a] != piece[b]) order.push_back(i);
    }
    std::ranges::stable_sort(order, std::greater<>{}, [&](std::size_t i) { return overlaps_[i].depth; });
    DisjointSets sets(static_cast<std::uint32_t>(piece.size()));
    for (std::uint32_t k = 0; k < piece.size(); ++k) sets.join(k, piece[k]);
    std::vector<std::pair<std::uint32_t, ElementBridge>> bridges;
    for (const std::size_t i : order) {
        const auto [a, b] = pairs_[i];
        if (sets.find(a) == sets.find(b)) continue;
        sets.join(a, b);
        const auto end_in = [&](std::uint32_t element) {
            const dvec3 at = overlaps_[i].at;
            const double gap = distance_of(elements_[element], shapes_, at, settings_.is_flat);
            return at - (gap + 0.5 * settings_.bridge) * outward(element, at);
        };
        bridges.push_back({a, {end_in(a), end_in(b)}});
    }
    for (std::uint32_t k = 0; k < piece.size(); ++k) piece[k] = sets.find(k);
    return bridges;
}

std::size_t Pieces::close(std::size_t pair, std::span<const std::uint32_t> piece, std::uint32_t main) {
    auto [still, loose] = pairs_[pair];
    if (piece[still] != main) std::swap(still, loose);
    // Towards the main piece, against the slope of its distance where the two are nearest.
    const dvec3 way = outward(still, overlaps_[pair].at);
    constexpr double deeper = 1.5;  // than asked: slopes are those of one point
    const dvec3 shift = -2 * (deeper * settings_.hold - overlaps_[pair].depth) * way;
    std::size_t moved = 0;
    const std::uint32_t number = piece[loose];
    for (std::uint32_t k = 0; k < elements_.size(); ++k) {
        if (piece[k] != number) continue;
        elements_[k].at += shift;
        if (settings_.settle) settings_.settle(elements_[k]);
        ++moved;
    }
    return moved;
}

}  // namespace

double bridge_length(const ElementBridge& bridge, double width) {
    constexpr double longer = 1.001;  // than wide, at least
    return std::max(length(bridge.to - bridge.from) + width, longer * width);
}

PlacedElement bridge_rod(const ElementBridge& bridge) {
    const dvec3 way = bridge.to - bridge.from;
    const double far = length(way);
    return {.shape = 0,
            .at = 0.5 * (bridge.from + bridge.to),
            .turn = shortest_turn({1, 0, 0}, far > 0 ? way / far : dvec3(1, 0, 0))};
}

Overlap overlap_of(const PlacedElement& a, const PlacedElement& b, std::span<const ElementShapePtr> shapes,
                   double reach, bool is_flat, const Field* body) {
    const double reach_a = reach_of(a, shapes), reach_b = reach_of(b, shapes);
    // Within both balls, grown by half of the reach.
    const Box box{glm::max(a.at - reach_a, b.at - reach_b) - 0.5 * reach,
                  glm::min(a.at + reach_a, b.at + reach_b) + 0.5 * reach};
    const bool is_apart = box.lo.x > box.hi.x || box.lo.y > box.hi.y || (!is_flat && box.lo.z > box.hi.z);
    if (is_apart) return {};
    // Distances change by at most 1 per mm: no point of the box may be near enough to both.
    const dvec3 middle_of_box = is_flat ? dvec3(dvec2(box.center()), a.at.z) : box.center();
    const double half_diagonal = 0.5 * length(is_flat ? dvec3(dvec2(box.size()), 0) : box.size());
    const auto depth_at = [&](dvec3 p) {
        return std::min(-distance_of(a, shapes, p, is_flat), -distance_of(b, shapes, p, is_flat));
    };
    if (depth_at(middle_of_box) + half_diagonal < -0.5 * reach) return {};
    constexpr int samples = 12;
    Overlap best;
    const auto try_at = [&](dvec3 p) {
        const double a_depth = -distance_of(a, shapes, p, is_flat);
        if (!(a_depth > best.depth)) return false;
        double depth = std::min(a_depth, -distance_of(b, shapes, p, is_flat));
        // The body's value may cost more than all else.
        if (body != nullptr && depth > best.depth) {
            constexpr double outside = 100;  // so that gaps are not closed beside the body
            const double value = body->value(p);
            depth = std::min(depth, value > 0 ? -outside * value : -value);
        }
        if (!(depth > best.depth)) return false;
        best = {depth, p};
        return true;
    };
    for (int k = 0; k < samples * samples * (is_flat ? 1 : samples); ++k) {
        const dvec3 share(k % samples, k / samples % samples, k / samples / samples);
        dvec3 p = box.lo + box.size() * (share + 0.5) / static_cast<double>(samples);
        if (is_flat) p.z = a.at.z;
        try_at(p);
    }
    if (best.depth + half_diagonal / samples < -0.5 * reach && body == nullptr) return best;
    const dvec3 size = box.size();
    double step = std::max({size.x, size.y, is_flat ? 0 : size.z}) / samples;
    const double finest = 1e-3 * std::min(reach_a, reach_b);
    while (step > finest) {
        const dvec3 middle = best.at;
        bool is_better = false;
        for (int k = 0; k < (is_flat ? 9 : 27); ++k)
            is_better |= try_at(middle + step * dvec3(k % 3 - 1, k / 3 % 3 - 1, is_flat ? 0 : k / 9 - 1));
        if (!is_better) step *= 0.5;
    }
    return best;
}

JoinedElements join_elements(std::vector<PlacedElement> elements, std::span<const double> loads,
                             std::span<const ElementShapePtr> shapes, const JoinSettings& settings) {
    JoinedElements joined;
    const std::size_t all = elements.size();
    Pieces pieces(std::move(elements), shapes, settings);
    std::vector<std::uint32_t> piece = pieces.pieces();
    std::vector<double> load(piece.size(), 0.0), busiest(piece.size(), 0.0);
    std::vector<std::uint8_t> is_counted(piece.size(), 0), touches_solid(piece.size(), 0);
    for (std::size_t k = 0; k < all; ++k) {
        joined.pieces += is_counted[piece[k]] == 0 ? 1 : 0;
        is_counted[piece[k]] = 1;
        load[piece[k]] += loads[k];
        busiest[piece[k]] = std::max(busiest[piece[k]], loads[k]);
    }
    for (std::size_t k = all; k < piece.size(); ++k) touches_solid[piece[k]] = 1;
    // Pieces are told by their lowest number, which joining changes: an element tells the main one.
    const auto in_main = static_cast<std::size_t>(std::ranges::max_element(load) - load.begin());
    std::vector<std::uint8_t> is_idle, stays;
    for (std::size_t k = 0; k < all; ++k) {
        is_idle.push_back(busiest[piece[k]] < settings.idle ? 1 : 0);
        stays.push_back(is_idle[k] != 0 || touches_solid[piece[k]] != 0 ? 1 : 0);
    }
    if (settings.bridge > 0) {
        const auto bridges = pieces.bridge(piece, is_idle);
        for (const auto& [element, bridge] : bridges) {
            if (piece[element] == piece[in_main]) joined.bridges.push_back(bridge);
        }
    } else {
        for (std::size_t round = 0; round < all; ++round) {
            const std::uint32_t main = piece[in_main];
            const auto gap = pieces.narrowest_gap(piece, main, stays);
            if (!gap) break;
            joined.moved += pieces.close(*gap, piece, main);
            piece = pieces.pieces();
        }
    }
    for (std::size_t k = 0; k < all; ++k) {
        if (piece[k] == piece[in_main]) {
            joined.elements.push_back(pieces.elements()[k]);
        } else {
            ++joined.dropped;
        }
    }
    for (std::size_t k = all; k < piece.size(); ++k) joined.apart += piece[k] != piece[in_main] ? 1 : 0;
    return joined;
}

}  // namespace lamella
