// Systematic samples by weight, then rounds of Lloyd's method with the nearest elements from a tree of
// points.
#include "procedural/elements/element_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elements/element_arrangement.h"
#include "procedural/voronoi/counter_hash.h"
#include "procedural/voronoi/point_tree.h"

namespace lamella {

namespace {

/// Returns a rotation, evenly distributed over all, from three numbers in [0, 1) (Shoemake 1992).
glm::dquat random_turn(double a, double b, double c) {
    const double low = std::sqrt(1 - a), high = std::sqrt(a);
    constexpr double round = 2 * std::numbers::pi;
    return glm::dquat(high * std::cos(round * c), low * std::sin(round * b), low * std::cos(round * b),
                      high * std::sin(round * c));
}

glm::dquat turn_about(dvec3 axis, double angle) { return glm::angleAxis(angle, axis); }

/// Returns the rotation that takes z to the normal and x to the tangent, two unit vectors at right angles.
glm::dquat turn_to_frame(dvec3 tangent, dvec3 normal) {
    return glm::normalize(glm::quat_cast(glm::dmat3(tangent, glm::cross(normal, tangent), normal)));
}

class Spread {
  public:
    Spread(const SpreadSites& sites, std::span<const ElementShapePtr> shapes, const SpreadSettings& settings)
        : sites_(sites), settings_(settings) {
        double least_half = infinity, greatest_half = 0;
        for (const ElementShapePtr& shape : shapes) {
            const Box box = shape->bounds();
            const dvec3 half = glm::max(glm::max(-box.lo, box.hi), dvec3(1e-3 * sites.spacing));
            halves_.push_back(half);
            const bool is_in_plane = sites.is_flat || !sites.normals.empty();
            least_half = std::min({least_half, half.x, half.y, is_in_plane ? half.x : half.z});
            greatest_half = std::max({greatest_half, half.x, half.y, is_in_plane ? half.x : half.z});
        }
        const double dimensions = sites.is_flat || !sites.normals.empty() ? 2 : 3;
        const double greatest = std::ranges::max(sites.densities);
        for (std::size_t i = 0; i < sites.size(); ++i) {
            const double density = std::pow(sites.densities[i] / greatest, (dimensions + 2) / dimensions);
            weights_.push_back(sites.sizes[i] * density);
        }
        const double thinnest = settings.scale.lo * least_half, longest = settings.scale.hi * greatest_half;
        farther_ = std::min(longest / thinnest, farthest) * (1 + 1e-9);
        deal_examples();
        start();
    }

    /// Moves elements to their centroids; returns by how much in the mean, mm.
    double iterate() {
        owner_ = owners();
        const std::vector<std::uint32_t>& owner = owner_;
        std::vector<dvec3> sum(elements_.size(), dvec3(0));
        std::vector<double> weight(elements_.size(), 0.0);
        for (std::size_t i = 0; i < owner.size(); ++i) {
            sum[owner[i]] += weights_[i] * sites_.places[i];
            weight[owner[i]] += weights_[i];
        }
        std::vector<std::uint32_t> nearest(elements_.size());
        std::vector<double> distance(elements_.size(), infinity);
        for (std::uint32_t i = 0; i < owner.size(); ++i) {
            const std::uint32_t k = owner[i];
            if (!(weight[k] > 0)) continue;
            const double d = squared_length(sites_.places[i] - towards(k, sum[k] / weight[k]));
            if (!(d < distance[k])) continue;
            distance[k] = d;
            nearest[k] = i;
        }
        double moved = 0;
        for (std::uint32_t k = 0; k < elements_.size(); ++k) {
            if (!(distance[k] < infinity)) continue;
            const dvec3 before = elements_[k].at;
            place(k, nearest[k], at_centroid(towards(k, sum[k] / weight[k]), nearest[k]));
            moved += length(elements_[k].at - before);
        }
        return moved / static_cast<double>(elements_.size());
    }
    const std::vector<PlacedElement>& elements() const { return elements_; }

  private:
    CounterHash draw(std::uint32_t element) const {
        return {settings_.seed, 3, static_cast<std::int64_t>(element), 0, 0};
    }

    /// Deals the example's elements as cards: shuffled decks, so that each comes as often as the others.
    void deal_examples() {
        const std::size_t each = settings_.example.size();
        if (each == 0) return;
        std::vector<std::pair<double, std::uint32_t>> cards;
        for (std::uint32_t i = 0; i < each; ++i) cards.emplace_back(0, i);
        for (std::size_t deck = 0; example_.size() < settings_.count; ++deck) {
            for (auto& [key, card] : cards)
                key = CounterHash(settings_.seed, 4, card, static_cast<std::int64_t>(deck), 0).uniform(0);
            std::ranges::sort(cards);
            for (std::size_t i = 0; i < each && example_.size() < settings_.count; ++i)
                example_.push_back(cards[i].second);
        }
    }

    /// Returns where a step towards a centroid leads: with an example a part of the way, so that rounds can
    /// end at its variation.
    dvec3 towards(std::uint32_t k, dvec3 centroid) const {
        constexpr double share = 0.3;
        return example_.empty() ? centroid : glm::mix(elements_[k].at, centroid, share);
    }

    /// Returns the centroid, which may lie beside a bent body or surface, at the nearest site if need be.
    dvec3 at_centroid(dvec3 centroid, std::uint32_t nearest) const {
        const dvec3 site = sites_.places[nearest], away = centroid - site;
        if (sites_.normals.empty()) return length(away) > sites_.spacing ? site : centroid;
        const dvec3 n = sites_.normals[nearest], aside = away - n * glm::dot(n, away);
        return length(aside) > sites_.spacing ? site : site + aside;
    }

    /// One element for each equal share of the densities, in the order of the sites.
    void start() {
        const double all =
            std::inner_product(sites_.sizes.begin(), sites_.sizes.end(), sites_.densities.begin(), 0.0);
        elements_.resize(settings_.count);
        site_.resize(settings_.count);
        double below = 0;
        std::uint32_t next = 0;
        for (std::uint32_t i = 0; i < sites_.size() && next < settings_.count; ++i) {
            below += sites_.sizes[i] * sites_.densities[i];
            while (next < settings_.count) {
                const double at = (next + draw(next).uniform(0)) * all / static_cast<double>(settings_.count);
                if (at >= below) break;
                begin(next++, i);
            }
        }
        for (const auto last = static_cast<std::uint32_t>(sites_.size() - 1); next < settings_.count; ++next)
            begin(next, last);
    }
    void begin(std::uint32_t k, std::uint32_t site) {
        const CounterHash chance = draw(k);
        elements_[k].shape =
            static_cast<std::uint32_t>(chance.uniform(1) * static_cast<double>(halves_.size()));
        elements_[k].scale = settings_.scale.lo + chance.uniform(2) * settings_.scale.width();
        if (!example_.empty()) {
            elements_[k].shape = settings_.example[example_[k]].shape;
            elements_[k].scale = settings_.example[example_[k]].scale;
        }
        place(k, site, sites_.places[site]);
    }

    /// Puts an element at a place near a site and turns it as it has to be there.
    void place(std::uint32_t k, std::uint32_t site, dvec3 at) {
        elements_[k].at = at;
        elements_[k].turn = glm::normalize(frame_of(site) * own_turn(k));
        site_[k] = site;
    }

    /// Returns the rotation to the frame of a site: that of the surface, or along its way.
    glm::dquat frame_of(std::uint32_t site) const {
        constexpr glm::dquat none(1, 0, 0, 0);
        if (!sites_.normals.empty()) return turn_to_frame(sites_.ways[site], sites_.normals[site]);
        if (!settings_.is_aligned) return none;
        const dvec3 way = sites_.ways[site];
        return sites_.is_flat ? turn_about({0, 0, 1}, std::atan2(way.y, way.x))
                              : shortest_turn({1, 0, 0}, way);
    }

    /// Returns how an element is turned in the frame of its site.
    glm::dquat own_turn(std::uint32_t k) const {
        constexpr glm::dquat none(1, 0, 0, 0);
        const bool is_in_plane = sites_.is_flat || !sites_.normals.empty();
        if (!settings_.turns) return none;
        if (!example_.empty()) {
            const glm::dquat turn = settings_.example[example_[k]].turn;
            const dvec3 x = turn * dvec3(1, 0, 0);
            return is_in_plane ? turn_about({0, 0, 1}, std::atan2(x.y, x.x)) : turn;
        }
        const CounterHash chance = draw(k);
        const double angle = 2 * std::numbers::pi * chance.uniform(3);
        if (is_in_plane) return settings_.is_aligned ? none : turn_about({0, 0, 1}, angle);
        if (settings_.is_aligned) return turn_about({1, 0, 0}, angle);
        return random_turn(chance.uniform(3), chance.uniform(4), chance.uniform(5));
    }

    /// Returns the element that each site is nearest to.
    std::vector<std::uint32_t> owners() const {
        std::vector<dvec3> places;
        for (const PlacedElement& element : elements_) places.push_back(element.at);
        const PointTree tree(places);
        std::vector<std::uint32_t> owner(sites_.size());
        parallel_for(sites_.size(), [&](std::size_t i) {
            const dvec3 p = sites_.places[i];
            const PointTree::Nearest nearest = tree.nearest(p, owner_.empty() ? 0 : owner_[i]);
            std::vector<std::uint32_t> near;
            tree.within(p, farther_ * std::sqrt(nearest.squared), near);
            std::pair best(infinity, nearest.point);
            for (const std::uint32_t k : near) {
                if (!sites_.normals.empty() && glm::dot(sites_.normals[i], sites_.normals[site_[k]]) < 0)
                    continue;
                best = std::min(best, std::pair(squared_distance(k, p), k));
            }
            owner[i] = best.second;
        });
        return owner;
    }

    /// Returns the squared distance by which cells are told apart: in the halves of the element's box, or
    /// from its middle, as that is what an example's spacings are.
    double squared_distance(std::uint32_t k, dvec3 p) const {
        if (!example_.empty()) return squared_length(p - elements_[k].at);
        dvec3 q = elements_[k].local(p) / halves_[elements_[k].shape];
        if (sites_.is_flat || !sites_.normals.empty()) q.z = 0;
        return squared_length(q);
    }

    const SpreadSites& sites_;
    const SpreadSettings& settings_;
    std::vector<dvec3> halves_;    ///< of the shapes' boxes
    std::vector<double> weights_;  ///< of the sites in centroids
    std::vector<PlacedElement> elements_;
    std::vector<std::uint32_t> example_;  ///< of each element, by number; may be empty
    std::vector<std::uint32_t> site_;     ///< nearest to each element
    std::vector<std::uint32_t> owner_;    ///< of each site, in the round before
    /// Elements farther away than the nearest one by this factor are not nearer in their own measure, or are
    /// not asked.
    double farther_ = 1;
    static constexpr double farthest = 3;
};

}  // namespace

std::vector<PlacedElement> spread_elements(const SpreadSites& sites, std::span<const ElementShapePtr> shapes,
                                           const SpreadSettings& settings) {
    if (sites.size() == 0 || !(std::ranges::max(sites.densities) > 0))
        throw InputError("no part of the body may hold elements; accepted: a density above 0 somewhere");
    Spread spread(sites, shapes, settings);
    for (int round = 0; round < settings.rounds; ++round) {
        stop_if_cancelled(settings.cancel);
        const bool is_even = settings.variation > 0 && settings.count > 1 &&
                             spacing_variation(spread.elements()) <= settings.variation;
        if (is_even) break;
        constexpr double still = 0.05;  // spacings
        if (spread.iterate() < still * sites.spacing) break;
    }
    return spread.elements();
}

SpreadCover cover_of(const SpreadSites& sites, std::span<const PlacedElement> elements,
                     std::span<const ElementShapePtr> shapes) {
    const PointTree tree(sites.places);
    std::vector<std::vector<std::uint32_t>> inside(elements.size());
    parallel_for(elements.size(), [&](std::size_t k) {
        const PlacedElement& element = elements[k];
        const ElementShape& shape = *shapes[element.shape];
        const Box box = shape.bounds();
        const double reach = element.scale * length(glm::max(-box.lo, box.hi));
        std::vector<std::uint32_t> near;
        tree.within(element.at, reach, near);
        for (const std::uint32_t i : near) {
            const dvec3 up = element.turn * dvec3(0, 0, 1);
            if (!sites.normals.empty() && glm::dot(sites.normals[i], up) < 0) continue;
            dvec3 p = element.local(sites.places[i]);
            if (sites.is_flat) p.z = 0;
            if (shape.distance(p) < 0) inside[k].push_back(i);
        }
    });
    std::vector<std::uint8_t> is_covered(sites.size(), 0);
    double all = 0, covered = 0;
    for (const auto& of_element : inside) {
        for (const std::uint32_t i : of_element) {
            all += sites.sizes[i];
            if (is_covered[i] == 0) covered += sites.sizes[i];
            is_covered[i] = 1;
        }
    }
    const double whole = std::accumulate(sites.sizes.begin(), sites.sizes.end(), 0.0);
    return {covered / whole, all > 0 ? 1 - covered / all : 0};
}

}  // namespace lamella
