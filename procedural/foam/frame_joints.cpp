// Components of a cell's frame by union-find; straight joints first, then paths through a lattice.
#include "procedural/foam/frame_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

namespace lamella {
namespace {

constexpr double allowed_outside = 0.25;  // share of the frame's radius
constexpr int lattice_points = 20;        // along the longest side of the cell
constexpr double reach_in_steps = 1.8;    // from a component to its first lattice points, in lattice steps

}  // namespace

std::uint32_t FrameJoints::point(dvec3 p) {
    const auto [entry, fresh] = points_.try_emplace(p, static_cast<std::uint32_t>(places_.size()));
    if (fresh) {
        connected_.add();
        places_.push_back(p);
    }
    return entry->second;
}

/// Adds the parts of the cell's edges inside the body. An edge is in the rings of two faces, so it is visited
/// once only.
void FrameJoints::add_edges(std::span<const CellFaces::Face> faces, SurfaceTracer& tracer) {
    std::set<std::pair<dvec3, dvec3>, PlaceOrder> seen;
    for (const CellFaces::Face& face : faces) {
        for (std::size_t i = 0; i < face.ring.size(); ++i) {
            dvec3 a = face.ring[i], b = face.ring[(i + 1) % face.ring.size()];
            if (PlaceOrder{}(b, a)) std::swap(a, b);
            if (!seen.insert({a, b}).second) continue;
            const std::vector<dvec3> ends = tracer.inside(a, b);
            for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
                const std::uint32_t first = point(ends[k]);
                for (int step = 1; step < SurfaceTracer::steps; ++step) {
                    const double t = static_cast<double>(step) / SurfaceTracer::steps;
                    connected_.join(first, point(ends[k] + (ends[k + 1] - ends[k]) * t));
                }
                connected_.join(first, point(ends[k + 1]));
            }
        }
    }
}

void FrameJoints::collect_components() {
    components_.clear();
    component_roots_.clear();
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::uint32_t r = connected_.find(static_cast<std::uint32_t>(i));
        const auto found = std::find(component_roots_.begin(), component_roots_.end(), r);
        if (found == component_roots_.end()) {
            component_roots_.push_back(r);
            components_.push_back({places_[i]});
        } else {
            components_[static_cast<std::size_t>(found - component_roots_.begin())].push_back(places_[i]);
        }
    }
}

/// Kruskal's algorithm: accepts candidates by length, each if it joins two components.
void FrameJoints::join(std::vector<Candidate>& candidates, std::vector<SurfaceCurve>& joints) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.length < b.length; });
    for (Candidate& candidate : candidates) {
        if (connected_.join(component_roots_[candidate.a], component_roots_[candidate.b]))
            joints.push_back(std::move(candidate.path));
    }
}

bool FrameJoints::leads_through(dvec3 p, dvec3 q, const Field& body, double allowance) const {
    const double radius = std::min(radius_.at(p), radius_.at(q));
    constexpr double most = 62;
    const int samples = static_cast<int>(std::min(length(q - p) / (0.5 * radius), most)) + 2;
    for (int i = 1; i < samples; ++i) {
        const double v = body.value_within(p + (q - p) * (static_cast<double>(i) / samples), radius);
        if (!(v < 0 || v <= allowance * radius)) return false;
    }
    return true;
}

/// Returns the lines between the nearest points of each pair of components, if they stay in the body.
std::vector<FrameJoints::Candidate> FrameJoints::straight(const Field& body) const {
    const double allowance = body.metric() == Metric::sign ? 0 : allowed_outside;
    std::vector<Candidate> candidates;
    for (std::size_t a = 0; a < components_.size(); ++a) {
        for (std::size_t b = a + 1; b < components_.size(); ++b) {
            Candidate candidate{infinity, a, b, {dvec3(0), dvec3(0)}};
            for (const dvec3& p : components_[a]) {
                for (const dvec3& q : components_[b]) {
                    const double d = length(q - p);
                    if (d < candidate.length) candidate = {d, a, b, {p, q}};
                }
            }
            if (leads_through(candidate.path[0], candidate.path[1], body, allowance)) {
                candidates.push_back(std::move(candidate));
            }
        }
    }
    return candidates;
}

/// Lattice points of the cell inside the body, each with a path to the nearest component.
struct FrameJoints::Lattice {
    static constexpr std::int32_t none = -1;
    struct Point {
        bool asked = false, inside = false, done = false;
        std::int32_t component = none;
        std::int32_t parent = none;
        std::int64_t distance = std::numeric_limits<std::int64_t>::max();
        dvec3 start{0};  ///< point of the component where the path begins
    };

    Lattice(std::span<const CellFaces::Face> faces, const Field& body_, const Seed& own_,
            std::span<const Seed> sites_, const Stretch& stretch_)
        : body(body_), own(own_), sites(sites_), stretch(stretch_) {
        for (const CellFaces::Face& face : faces) {
            for (const dvec3& corner : face.ring) box.include(corner);
        }
        const dvec3 extent = box.size();
        step = std::max({extent.x, extent.y, extent.z}) / lattice_points;
        size = glm::ivec3(glm::floor(extent / step)) + 1;
        points.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                      static_cast<std::size_t>(size.z));
    }

    bool holds(glm::ivec3 at) const {
        return glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) && glm::all(glm::lessThan(at, size));
    }
    std::size_t index(glm::ivec3 at) const {
        const auto n = [](int v) { return static_cast<std::size_t>(v); };
        return (n(at.z) * n(size.y) + n(at.y)) * n(size.x) + n(at.x);
    }
    glm::ivec3 at(std::size_t i) const {
        const auto n = static_cast<int>(i);
        return {n % size.x, n / size.x % size.y, n / size.x / size.y};
    }
    dvec3 place(std::size_t i) const { return box.lo + (dvec3(at(i)) + 0.5) * step; }

    bool inside(std::size_t i) {
        Point& point = points[i];
        if (point.asked) return point.inside;
        point.asked = true;
        const dvec3 p = place(i), seed_place = stretch.to_seeds(p);
        const dvec3 from_own = seed_place - own.position;
        const double nearest = glm::dot(from_own, from_own);
        for (const Seed& site : sites) {
            const dvec3 from_site = seed_place - site.position;
            if (glm::dot(from_site, from_site) < nearest) return false;
        }
        return point.inside = body.value_within(p, step) < 0;
    }

    const Field& body;
    const Seed& own;
    std::span<const Seed> sites;
    const Stretch& stretch;
    Box box;
    double step = 1;
    glm::ivec3 size{0};
    std::vector<Point> points;
};

/// Grows all components at once through the lattice (Dijkstra); where two fronts meet there is a path.
std::vector<FrameJoints::Candidate> FrameJoints::paths(std::span<const CellFaces::Face> faces,
                                                       const Field& body, const Seed& own,
                                                       std::span<const Seed> sites,
                                                       const Stretch& stretch) const {
    Lattice lattice(faces, body, own, sites, stretch);
    using Entry = std::pair<std::int64_t, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    constexpr std::int64_t unit = 1000;
    const int reach = static_cast<int>(std::ceil(reach_in_steps));
    for (std::size_t c = 0; c < components_.size(); ++c) {
        for (const dvec3& p : components_[c]) {
            const glm::ivec3 home(glm::floor((p - lattice.box.lo) / lattice.step));
            for (int n = 0; n < (2 * reach + 1) * (2 * reach + 1) * (2 * reach + 1); ++n) {
                const int side = 2 * reach + 1;
                const glm::ivec3 at = home + glm::ivec3(n % side, n / side % side, n / side / side) - reach;
                if (!lattice.holds(at)) continue;
                const std::size_t i = lattice.index(at);
                const double d = length(lattice.place(i) - p) / lattice.step;
                const auto distance = static_cast<std::int64_t>(d * unit);
                Lattice::Point& point = lattice.points[i];
                if (d > reach_in_steps || distance >= point.distance || !lattice.inside(i)) continue;
                point.distance = distance;
                point.component = static_cast<std::int32_t>(c);
                point.start = p;
                front.push({distance, i});
            }
        }
    }
    const auto way = [&](std::size_t i) {
        SurfaceCurve points;
        for (;;) {
            points.push_back(lattice.place(i));
            const Lattice::Point& point = lattice.points[i];
            if (point.parent == Lattice::none) {
                points.push_back(point.start);
                return points;
            }
            i = static_cast<std::size_t>(point.parent);
        }
    };
    std::map<std::pair<std::size_t, std::size_t>, std::tuple<std::int64_t, std::size_t, std::size_t>>
        meetings;
    while (!front.empty()) {
        const auto [distance, i] = front.top();
        front.pop();
        Lattice::Point& here = lattice.points[i];
        if (here.done || distance > here.distance) continue;
        here.done = true;
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 way_on = glm::ivec3(n % 3, n / 3 % 3, n / 9) - 1;
            const glm::ivec3 at = lattice.at(i) + way_on;
            const int axes = std::abs(way_on.x) + std::abs(way_on.y) + std::abs(way_on.z);
            if (axes == 0 || !lattice.holds(at)) continue;
            const std::size_t j = lattice.index(at);
            if (!lattice.inside(j)) continue;
            Lattice::Point& there = lattice.points[j];
            const std::int64_t step = axes == 1 ? unit : axes == 2 ? 1414 : 1732;
            if (there.done) {
                if (there.component == here.component) continue;
                auto pair = std::minmax(here.component, there.component);
                const std::pair key(static_cast<std::size_t>(pair.first),
                                    static_cast<std::size_t>(pair.second));
                const std::tuple meeting(here.distance + there.distance + step, i, j);
                const auto [entry, fresh] = meetings.try_emplace(key, meeting);
                if (!fresh && meeting < entry->second) entry->second = meeting;
            } else if (here.distance + step < there.distance) {
                there.distance = here.distance + step;
                there.component = here.component;
                there.parent = static_cast<std::int32_t>(i);
                front.push({there.distance, j});
            }
        }
    }
    std::vector<Candidate> candidates;
    for (const auto& [pair, meeting] : meetings) {
        const auto [distance, i, j] = meeting;
        SurfaceCurve path = way(i);
        std::reverse(path.begin(), path.end());
        const SurfaceCurve rest = way(j);
        path.insert(path.end(), rest.begin(), rest.end());
        candidates.push_back({static_cast<double>(distance), pair.first, pair.second, shortened(path, body)});
    }
    return candidates;
}

/// Returns the path without the points that a straight line inside the body can skip.
SurfaceCurve FrameJoints::shortened(const SurfaceCurve& path, const Field& body) const {
    SurfaceCurve kept{path.front()};
    for (std::size_t at = 0; at + 1 < path.size();) {
        std::size_t next = path.size() - 1;
        while (next > at + 1 && !leads_through(path[at], path[next], body, 0)) --next;
        kept.push_back(path[next]);
        at = next;
    }
    return kept;
}

std::vector<SurfaceCurve> FrameJoints::joints(std::span<const CellFaces::Face> faces,
                                              std::span<const SurfaceCurve> curves, SurfaceTracer& tracer,
                                              const Seed& own, std::span<const Seed> sites,
                                              const Stretch& stretch) {
    points_.clear();
    places_.clear();
    connected_ = DisjointSets();
    std::vector<SurfaceCurve> joints;
    for (const SurfaceCurve& curve : curves) {
        const std::uint32_t first = point(curve.front());
        for (const dvec3& p : curve) connected_.join(first, point(p));
    }
    if (edges_hold_) add_edges(faces, tracer);
    collect_components();
    if (components_.size() < 2) return joints;
    std::vector<Candidate> candidates = straight(tracer.body());
    join(candidates, joints);
    collect_components();
    if (components_.size() < 2) return joints;
    candidates = paths(faces, tracer.body(), own, sites, stretch);
    join(candidates, joints);
    return joints;
}

}  // namespace lamella
