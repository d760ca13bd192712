// Random sequential addition, and a lattice that grows along the surface.
#include "procedural/skin/surface_seeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <queue>
#include <unordered_map>

#include "engine/base/error.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {
namespace {

constexpr double scatter_spacing = 0.80;  // in pitches; leaves one seed per pitch^2, measured on a plane
constexpr double lattice_spacing = 0.75;  // in pitches
constexpr double foot_precision = 1e-3;   // in pitches
constexpr int cubes_per_pitch = 4;

/// A hash grid of seeds, to test whether another one fits.
class SeedGrid {
  public:
    explicit SeedGrid(double spacing) : spacing_(spacing) {}

    /// Returns whether all seeds are at least the spacing less `slack` away, mm.
    bool fits(const SurfaceFoot& foot, double slack = 0) const {
        const double least = (spacing_ - slack) * (spacing_ - slack);
        const glm::i64vec3 center = cell(foot.place);
        for (int n = 0; n < 27; ++n) {
            const auto found = cells_.find(key(center + glm::i64vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
            if (found == cells_.end()) continue;
            for (const std::uint32_t i : found->second) {
                const dvec3 way = seeds_[i].place - foot.place;
                if (glm::dot(way, way) < least && !back_to_back(seeds_[i].normal, foot.normal)) return false;
            }
        }
        return true;
    }
    void add(const SurfaceFoot& foot) {
        if (seeds_.size() == max_surface_seeds) {
            throw InputError(fmt::format("the skin would have more than {} windows; accepted: larger ones",
                                         max_surface_seeds));
        }
        cells_[key(cell(foot.place))].push_back(static_cast<std::uint32_t>(seeds_.size()));
        seeds_.push_back(foot);
    }
    std::vector<SurfaceFoot> take() { return std::move(seeds_); }

  private:
    glm::i64vec3 cell(dvec3 p) const {
        const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / spacing_)); };
        return {index(p.x), index(p.y), index(p.z)};
    }
    /// Cells far apart may share a key; distances are compared anyway.
    static std::uint64_t key(glm::i64vec3 c) { return CounterHash(0, 0, c.x, c.y, c.z).bits(0); }

    double spacing_;
    std::vector<SurfaceFoot> seeds_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// Visits cubes of side pitch / cubes_per_pitch along the surface.
void walk_small_cubes(const Field& body, double pitch, const std::function<void(const LatticeCube&)>& visit) {
    const double side = pitch / cubes_per_pitch, largest = 16 * side;
    const double volume = diagonal(body.bounds()) / side;
    if (!(volume < 1e6)) {
        throw InputError(fmt::format(
            "windows {:.4g} mm apart are too small for a body of {:.4g} mm; accepted: larger ones", pitch,
            diagonal(body.bounds())));
    }
    walk_surface(
        body, largest, 0, [&](const LatticeCube& cube) { return cube.side > 1.5 * side; }, visit);
}

/// Returns the projection of a place onto the surface if a seed fits there. One step towards it rejects most
/// of those that do not fit.
std::optional<SurfaceFoot> fitting_foot(const Field& body, dvec3 place, double pitch, const SeedGrid& seeds) {
    const double precision = foot_precision * pitch;
    const auto normal = rising(body, place, precision);
    if (!normal) return std::nullopt;
    const SurfaceFoot near{place - *normal * body.value(place), *normal};
    if (!seeds.fits(near, 0.2 * pitch)) return std::nullopt;
    const auto foot = foot_on_surface(body, near.place, precision);
    return foot && seeds.fits(*foot) ? foot : std::nullopt;
}

/// A place where the lattice may continue.
struct Proposal {
    double bend;  ///< accumulated bend of the surface on the path to here
    std::uint64_t number;
    dvec3 place;
    dvec3 along;  ///< towards one of the six neighbours

    /// The queue returns the least bend first, and among equal ones the last added, so that a face is filled
    /// from one seed.
    bool operator<(const Proposal& other) const {
        return bend != other.bend ? bend > other.bend : number < other.number;
    }
};

/// Returns the unit tangential part of a direction.
dvec3 tangent(dvec3 direction, dvec3 normal) {
    dvec3 flat = direction - normal * glm::dot(direction, normal);
    if (glm::dot(flat, flat) < 1e-2) {
        const dvec3 other(direction.y, direction.z, direction.x);
        flat = other - normal * glm::dot(other, normal);
    }
    return flat / std::sqrt(glm::dot(flat, flat));
}

class LatticeFront {
  public:
    LatticeFront(const Field& body, double pitch)
        : body_(body), pitch_(pitch), seeds_(lattice_spacing * pitch) {}

    /// Starts a lattice at the projection of a place, unless there is a seed nearby.
    void start(dvec3 place) {
        const auto foot = fitting_foot(body_, place, pitch_, seeds_);
        if (!foot) return;
        accept(*foot, tangent({1, 0, 0}, foot->normal), 0);
        while (!open_.empty()) {
            const Proposal next = open_.top();
            open_.pop();
            settle(next);
        }
    }
    std::vector<SurfaceFoot> take() { return seeds_.take(); }

  private:
    void settle(const Proposal& next) {
        const auto foot = feet_.find(next.number);
        const SurfaceFoot settled = foot->second;
        feet_.erase(foot);
        if (seeds_.fits(settled)) accept(settled, tangent(next.along, settled.normal), next.bend);
    }

    void accept(const SurfaceFoot& foot, dvec3 along, double bend) {
        seeds_.add(foot);
        const dvec3 aside = glm::cross(foot.normal, along);
        const double half = 0.5, high = std::sqrt(0.75);
        const dvec3 ways[] = {along,  along * half + aside * high,  along * -half + aside * high,
                              -along, along * -half - aside * high, along * half - aside * high};
        for (const dvec3 way : ways) propose(foot, foot.place + way * pitch_, along, bend);
    }

    void propose(const SurfaceFoot& from, dvec3 place, dvec3 along, double bend) {
        if (!seeds_.fits({place, from.normal}, 0.2 * pitch_)) return;
        const auto foot = foot_on_surface(body_, place, foot_precision * pitch_);
        if (!foot || !seeds_.fits(*foot)) return;
        const double turned = 1 - glm::dot(from.normal, foot->normal);
        constexpr double flat = 1e-9;
        open_.push({turned > flat ? bend + turned : bend, ++count_, foot->place, along});
        feet_.emplace(count_, *foot);
    }

    const Field& body_;
    double pitch_;
    SeedGrid seeds_;
    std::priority_queue<Proposal> open_;
    std::unordered_map<std::uint64_t, SurfaceFoot> feet_;  ///< seeds of the open proposals, by number
    std::uint64_t count_ = 0;
};

}  // namespace

std::vector<SurfaceFoot> scatter_on_surface(const Field& body, double pitch, std::uint64_t seed) {
    struct Candidate {
        std::uint64_t turn;
        dvec3 place;
    };
    std::vector<Candidate> candidates;
    walk_small_cubes(body, pitch, [&](const LatticeCube& cube) {
        const CounterHash hash(seed, 0, cube.index.x, cube.index.y, cube.index.z);
        const dvec3 share(hash.uniform(0), hash.uniform(1), hash.uniform(2));
        candidates.push_back({hash.bits(3), cube.box().lo + share * cube.side});
        if (candidates.size() > 24 * max_surface_seeds) {
            throw InputError(fmt::format("the skin would have more than {} windows; accepted: larger ones",
                                         max_surface_seeds));
        }
    });
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.turn < b.turn; });
    SeedGrid seeds(scatter_spacing * pitch);
    for (const Candidate& candidate : candidates) {
        if (const auto foot = fitting_foot(body, candidate.place, pitch, seeds)) seeds.add(*foot);
    }
    return seeds.take();
}

std::vector<SurfaceFoot> hexagons_on_surface(const Field& body, double pitch) {
    LatticeFront front(body, pitch);
    walk_small_cubes(body, pitch, [&](const LatticeCube& cube) { front.start(cube.box().center()); });
    return front.take();
}

}  // namespace lamella
