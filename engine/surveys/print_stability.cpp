// PrintStability: moments about the edges of convex hulls, which grow with every support point.
#include "engine/surveys/print_stability.h"

#include <algorithm>

#include "engine/base/convex_hull.h"

namespace lamella {
namespace {

constexpr double gravity = 9.80665e-6;  // N per g/cm^3 and mm^3
constexpr double widening = 0.2;        // mm by which a point must widen the hull to count
constexpr double further = 0.05;        // mm by which a place must lie farther out than a lower one

constexpr double c1 = 0.92387953251128674, c2 = 0.70710678118654752, c3 = 0.38268343236508977;
constexpr std::array<std::array<double, 2>, 16> compass{{{1, 0},
                                                         {c1, c3},
                                                         {c2, c2},
                                                         {c3, c1},
                                                         {0, 1},
                                                         {-c3, c1},
                                                         {-c2, c2},
                                                         {-c1, c3},
                                                         {-1, 0},
                                                         {-c1, -c3},
                                                         {-c2, -c2},
                                                         {-c3, -c1},
                                                         {0, -1},
                                                         {c3, -c1},
                                                         {c2, -c2},
                                                         {c1, -c3}}};

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

PrintStability::PrintStability(const StabilityLimits& limits, double spacing, double bed)
    : limits_(limits), spacing_(spacing), bed_(bed) {
    constexpr double octagon = 2 * 1.4142135623730951;  // area over the circumradius squared
    contact_radius_ = std::sqrt(limits.contact / octagon);
}

void PrintStability::add(std::uint32_t component, double volume, dvec2 moment) {
    Component& c = components_[component];
    c.volume += volume;
    c.moment += moment;
}

void PrintStability::lay_on_bed(std::uint32_t component, double area, dvec2 moment,
                                const std::vector<dvec2>& border) {
    Component& c = components_[component];
    c.bed.weight += area;
    c.bed.moment += moment;
    c.lowest = bed_;
    append(c.fresh, border);
}

void PrintStability::hold(std::uint32_t component, dvec3 point) { hold(components_[component], point); }

void PrintStability::hold(Component& c, dvec3 point) const {
    const dvec2 at(point.x, point.y);
    c.points.weight += 1;
    c.points.moment += at;
    c.lowest = std::min(c.lowest, point.z);
    c.held.push_back(point);
    for (std::size_t k = 0; k < compass.size(); k += 2) {
        c.fresh.push_back(at + contact_radius_ * dvec2(compass[k][0], compass[k][1]));
    }
}

bool PrintStability::wants(std::uint32_t component, dvec3 place) const {
    const auto found = components_.find(component);
    if (found == components_.end()) return true;
    for (std::size_t k = 0; k < directions; ++k) {
        if (place.x * compass[k][0] + place.y * compass[k][1] > found->second.reach[k] + further) return true;
    }
    return false;
}

void PrintStability::offer(std::uint32_t component, dvec3 place) {
    Component& c = components_[component];
    for (std::size_t k = 0; k < directions; ++k) {
        const double reach = place.x * compass[k][0] + place.y * compass[k][1];
        if (!(reach > c.reach[k] + further)) continue;
        c.reach[k] = reach;
        c.places[k] = place;
    }
}

void PrintStability::join(std::uint32_t kept, std::uint32_t joined) {
    const auto found = components_.find(joined);
    if (found == components_.end()) return;
    Component& c = components_[kept];
    const Component& other = found->second;
    const bool none_yet = c.volume == 0;
    c.volume += other.volume;
    c.moment += other.moment;
    c.bed.weight += other.bed.weight;
    c.bed.moment += other.bed.moment;
    c.points.weight += other.points.weight;
    c.points.moment += other.points.moment;
    c.lowest = std::min(c.lowest, other.lowest);
    append(c.fresh, other.hull);
    append(c.fresh, other.fresh);
    append(c.held, other.held);
    for (std::size_t k = 0; k < directions; ++k) {
        if (!(other.reach[k] > c.reach[k])) continue;
        c.reach[k] = other.reach[k];
        c.places[k] = other.places[k];
    }
    c.toppled = none_yet ? other.toppled : c.toppled && other.toppled;
    components_.erase(joined);
}

void PrintStability::keep_only(const std::vector<std::uint32_t>& components) {
    for (auto at = components_.begin(); at != components_.end();) {
        at = std::binary_search(components.begin(), components.end(), at->first) ? std::next(at)
                                                                                 : components_.erase(at);
    }
}

PrintStability::Edge PrintStability::weakest_edge(const Component& c, double height) const {
    Edge weakest{dvec2(0), dvec2(0), infinity};
    const double weight = c.volume * limits_.density * gravity;
    const double push = limits_.push * (height - c.lowest);
    for (std::size_t k = 0; k < c.hull.size(); ++k) {
        const dvec2 along = c.hull[(k + 1) % c.hull.size()] - c.hull[k];
        const double length = std::sqrt(along.x * along.x + along.y * along.y);
        Edge edge{c.hull[k], dvec2(-along.y, along.x) / length, -push};
        edge.moment += weight * (edge.distance(c.moment / c.volume) - limits_.margin);
        if (c.bed.weight > 0) {
            edge.moment += limits_.adhesion * c.bed.weight * edge.distance(c.bed.moment / c.bed.weight);
        }
        if (c.points.weight > 0) {
            edge.moment += limits_.bond * limits_.contact * c.points.weight *
                           edge.distance(c.points.moment / c.points.weight);
        }
        if (edge.moment < weakest.moment) weakest = edge;
    }
    return weakest;
}

const dvec3* PrintStability::max_helpful(const Component& c, const Edge& edge) const {
    const dvec3* furthest_out = nullptr;
    const dvec3* furthest_in = nullptr;  // there a point holds the part down
    double out = -widening, in = 0;
    for (std::size_t k = 0; k < directions; ++k) {
        if (c.reach[k] == -infinity) continue;
        const dvec3& place = c.places[k];
        const double distance = edge.distance({place.x, place.y});
        if (distance - contact_radius_ < out) {
            out = distance - contact_radius_;
            furthest_out = &place;
        }
        if (!(distance > in)) continue;
        const bool crowded = std::any_of(c.held.begin(), c.held.end(), [&](dvec3 p) {
            const dvec3 d = p - place;
            return d.x * d.x + d.y * d.y + d.z * d.z < spacing_ * spacing_ / 4;
        });
        if (crowded) continue;
        in = distance;
        furthest_in = &place;
    }
    return furthest_out != nullptr ? furthest_out : furthest_in;
}

void PrintStability::make_steady(Component& c, double height, std::vector<dvec3>& added) {
    while (c.volume > 0 && !c.toppled) {
        if (!c.fresh.empty()) {
            append(c.fresh, c.hull);
            c.hull = convex_hull(std::move(c.fresh));
            c.fresh.clear();
        }
        if (height - c.lowest < limits_.min_height && c.hull.size() >= 3) return;
        const dvec3* help = nullptr;
        if (c.hull.size() >= 3) {
            const Edge edge = weakest_edge(c, height);
            if (edge.moment >= 0) return;
            help = max_helpful(c, edge);
        } else if (c.reach[0] > -infinity) {
            help = c.places.data();
        }
        if (help == nullptr) {
            c.toppled = true;
            topples_at_ = std::min(topples_at_, height);
            return;
        }
        added.push_back(*help);
        hold(c, added.back());
    }
}

std::vector<dvec3> PrintStability::steady(double height) {
    std::vector<dvec3> added;
    for (auto& [number, component] : components_) make_steady(component, height, added);
    return added;
}

}  // namespace lamella
