// Leaf cubes by level and index, and the faces between cubes of different charts.
#include "procedural/skin/surface_charts.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {
namespace {

constexpr int levels = 5;  // of cubes: the largest are 16 times as wide as the finest
constexpr int largest_chart = 1 << (levels - 1);
constexpr double max_cubes = 1e5;  // along the body's diagonal
constexpr std::size_t max_leaves = 20'000'000;
constexpr double slope_step = 1e-3;  // share of the finest cube

int level_of(double side, double finest) {
    int level = 0;
    while (side < finest * largest_chart * 0.75) {
        side *= 2;
        ++level;
    }
    return level;
}

std::optional<Chart> chart_of(const Field& body, dvec3 p, double step) {
    const auto normal = rising(body, p, step);
    if (!normal) return std::nullopt;
    Chart chart;
    double best = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double share = std::abs((*normal)[axis]) * (1 + 0.01 * axis);
        if (share <= best) continue;
        best = share;
        chart = {axis, (*normal)[axis] > 0};
    }
    return chart;
}

/// Returns whether the corners and the centre have one chart.
bool uniform(const Field& body, const Box& box, double step) {
    const auto middle = chart_of(body, box.center(), step);
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 share(corner & 1, (corner >> 1) & 1, corner >> 2);
        if (chart_of(body, box.lo + share * box.size(), step) != middle) return false;
    }
    return true;
}

}  // namespace

std::size_t SurfaceCharts::Hash::operator()(const Key& key) const {
    return static_cast<std::size_t>(CounterHash(0, key.level, key.index.x, key.index.y, key.index.z).bits(0));
}

SurfaceCharts::SurfaceCharts(const Field& body, double finest, double depth) : finest_(finest) {
    const double across = diagonal(body.bounds()) / finest;
    if (!(finest > 0) || !(across < max_cubes)) {
        throw InputError(fmt::format("struts are too narrow for a body of {:.4g} mm; accepted: wider ones",
                                     diagonal(body.bounds())));
    }
    const double step = slope_step * finest;
    std::vector<LatticeCube> cubes;
    walk_surface(
        body, finest * largest_chart, depth,
        [&](const LatticeCube& cube) {
            return level_of(cube.side, finest_) + 1 < levels && !uniform(body, cube.box(), step);
        },
        [&](const LatticeCube& cube) {
            const auto chart = chart_of(body, cube.box().center(), step);
            if (!chart) return;
            if (leaves_.size() == max_leaves) {
                throw InputError("struts are too narrow for so large a surface; accepted: wider ones");
            }
            const Key key{level_of(cube.side, finest_), cube.index};
            numbers_[key] = static_cast<std::uint32_t>(leaves_.size());
            leaves_.push_back({key, *chart});
            cubes.push_back(cube);
        });
    std::vector<dvec3> seams;
    for (std::size_t i = 0; i < cubes.size(); ++i) collect_seams(cubes[i], leaves_[i].chart, seams);
    seams_ = std::make_unique<const PointTree>(std::move(seams));
    const double far = 4 * largest_chart * finest_;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        const Box box = cubes[i].box();
        leaves_[i].clear = seams_->distance_within(box.center(), far) - 0.5 * diagonal(box);
    }
}

SurfaceCharts::Key SurfaceCharts::key(dvec3 p, int level) const {
    const double side = finest_ * (largest_chart >> level);
    const auto index = [&](double v) { return static_cast<std::int64_t>(std::floor(v / side)); };
    return {level, {index(p.x), index(p.y), index(p.z)}};
}

std::uint32_t SurfaceCharts::leaf_at(dvec3 p, std::uint32_t guess) const {
    if (guess < leaves_.size() && key(p, leaves_[guess].key.level) == leaves_[guess].key) return guess;
    for (int level = 0; level < levels; ++level) {
        if (const auto found = numbers_.find(key(p, level)); found != numbers_.end()) return found->second;
    }
    return none;
}

std::optional<Chart> SurfaceCharts::at(dvec3 p) const {
    const std::uint32_t leaf = leaf_at(p);
    return leaf == none ? std::nullopt : std::optional(chart(leaf));
}

/// Appends the centres of those faces of a cube that border another chart, in squares of the finest cube's
/// side.
void SurfaceCharts::collect_seams(const LatticeCube& cube, Chart chart, std::vector<dvec3>& seams) const {
    const Box box = cube.box();
    const int count = largest_chart >> level_of(cube.side, finest_);
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, one = (axis + 1) % 3, two = (axis + 2) % 3;
        const double beyond = face % 2 == 0 ? -0.5 : 0.5;
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < count; ++j) {
                dvec3 middle = box.lo;
                middle[axis] = face % 2 == 0 ? box.lo[axis] : box.hi[axis];
                middle[one] += (i + 0.5) * finest_;
                middle[two] += (j + 0.5) * finest_;
                dvec3 neighbour = middle;
                neighbour[axis] += beyond * finest_;
                const auto other = at(neighbour);
                if (other && !(*other == chart)) seams.push_back(middle);
            }
        }
    }
}

double SurfaceCharts::seam_distance(std::uint32_t leaf, dvec3 p, double limit) const {
    constexpr double half_diagonal = 0.7072;  // of a square
    const double slack = half_diagonal * finest_, reach = limit + slack;
    const bool is_clear = reach <= leaves_[leaf].clear;
    return (is_clear ? reach : seams_->distance_within(p, reach)) - slack;
}

}  // namespace lamella
