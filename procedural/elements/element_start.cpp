// Dart throwing with a radius that shrinks, over candidates whose order follows the densities.
#include "procedural/elements/element_start.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "engine/base/error.h"
#include "procedural/texture/lattice_hash.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {

namespace {

struct Candidate {
    double key;
    std::uint32_t cell;
    dvec3 at;
};

/// Returns points in the cells, the first ones likelier where densities are high.
std::vector<Candidate> candidates_of(const CellGrid& grid, std::span<const double> densities,
                                     const StartSettings& settings) {
    const std::size_t each = 1 + 8 * settings.count / grid.cells();
    std::vector<Candidate> candidates;
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                const std::size_t cell = grid.number({x, y, z});
                if (!(densities[cell] > 0)) continue;
                for (std::size_t k = 0; k < each; ++k) {
                    const CounterHash draw(settings.seed, 1, static_cast<std::int64_t>(cell),
                                           static_cast<std::int64_t>(k), 0);
                    const dvec3 aside(draw.uniform(1) - 0.5, draw.uniform(2) - 0.5,
                                      grid.is_flat ? 0 : draw.uniform(3) - 0.5);
                    candidates.push_back({draw.uniform(0) / densities[cell], static_cast<std::uint32_t>(cell),
                                          grid.centre({x, y, z}) + aside * grid.edges});
                }
            }
        }
    }
    std::ranges::sort(candidates, {}, [](const Candidate& c) { return std::pair(c.key, c.cell); });
    return candidates;
}

/// Points that keep a distance from each other, found by the squares or cubes of a lattice.
class SpacedPoints {
  public:
    explicit SpacedPoints(double spacing) : spacing_(spacing) {}

    bool add(dvec3 p) {
        const glm::i64vec3 cube(glm::floor(p / spacing_));
        for (int k = 0; k < 27; ++k) {
            const auto [begin, end] =
                points_.equal_range(cube + glm::i64vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
            for (auto other = begin; other != end; ++other) {
                if (squared_length(other->second - p) < spacing_ * spacing_) return false;
            }
        }
        points_.emplace(cube, p);
        return true;
    }

  private:
    double spacing_;
    std::unordered_multimap<glm::i64vec3, dvec3, LatticeHash> points_;
};

}  // namespace

glm::dquat turn_to(dvec3 way) {
    if (way.x < 0) way = -way;  // an axis points both ways
    return glm::normalize(glm::dquat(1 + way.x, 0, -way.z, way.y));
}

std::vector<PlacedElement> sampled_elements(const CellGrid& grid, std::span<const double> densities,
                                            std::span<const dvec3> ways, const StartSettings& settings) {
    const std::vector<Candidate> candidates = candidates_of(grid, densities, settings);
    if (candidates.empty())
        throw InputError("no cell of the body can hold elements; accepted: a body with some material");
    std::vector<const Candidate*> chosen;
    double spacing = length(grid.box().size());
    // Where too few candidates remain apart, they are taken again.
    constexpr double shrink = 0.9, least = 1e-3;
    while (chosen.size() < settings.count && spacing > least * grid.edge()) {
        chosen.clear();
        SpacedPoints points(spacing);
        for (const Candidate& candidate : candidates) {
            if (points.add(candidate.at)) chosen.push_back(&candidate);
            if (chosen.size() == settings.count) break;
        }
        spacing *= shrink;
    }
    for (std::size_t i = 0; chosen.size() < settings.count; ++i)
        chosen.push_back(&candidates[i % candidates.size()]);
    std::vector<PlacedElement> elements;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const CounterHash draw(settings.seed, 2, static_cast<std::int64_t>(k), 0, 0);
        PlacedElement element{.shape = static_cast<std::uint32_t>(draw.uniform(0) * settings.shapes),
                              .at = chosen[k]->at,
                              .scale = 0.5 * (settings.scale.lo + settings.scale.hi)};
        if (settings.turns) {
            dvec3 way(2 * draw.uniform(1) - 1, 2 * draw.uniform(2) - 1,
                      grid.is_flat ? 0 : 2 * draw.uniform(3) - 1);
            if (!ways.empty()) way = ways[chosen[k]->cell];
            element.turn = turn_to(way / length(way));
        }
        elements.push_back(element);
    }
    return elements;
}

}  // namespace lamella
