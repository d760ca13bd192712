// One pass over the points of the surface; what lies below a point is looked for in its column.
#include "procedural/orientation/orientation_figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/convex_hull.h"

namespace lamella {

namespace {

/// The sites in the direction's own axes, by the square column that they lie in.
struct Columns {
    std::vector<dvec3> places;          ///< of all sites; z along the direction
    std::vector<std::uint32_t> column;  ///< of each site
    std::vector<std::uint32_t> first;   ///< of each column in `sites`, and the end
    std::vector<std::uint32_t> sites;   ///< column by column
    double low = infinity, high = -infinity;
};

Columns columns_of(const SurfaceCover& cover, dvec3 up) {
    const std::size_t count = cover.sites.size();
    const auto [a, b] = across(up);
    Columns columns;
    columns.places.reserve(count);
    Rect seen;
    for (const dvec3& p : cover.sites.places) {
        const dvec3 at(dot(p, a), dot(p, b), dot(p, up));
        columns.places.push_back(at);
        seen.lo = glm::min(seen.lo, dvec2(at));
        seen.hi = glm::max(seen.hi, dvec2(at));
        columns.low = std::min(columns.low, at.z);
        columns.high = std::max(columns.high, at.z);
    }
    // Wide enough that no column of a smooth surface is without a point, and not many more than points.
    const dvec2 size = seen.size();
    const double width =
        std::max(2 * cover.sites.spacing, std::sqrt(size.x * size.y / (4.0 * static_cast<double>(count))));
    const auto across_x = static_cast<std::uint32_t>(size.x / width) + 1;
    const auto across_y = static_cast<std::uint32_t>(size.y / width) + 1;
    columns.first.assign(std::size_t{across_x} * across_y + 1, 0);
    columns.column.reserve(count);
    for (const dvec3& at : columns.places) {
        const dvec2 cell = (dvec2(at) - seen.lo) / width;
        columns.column.push_back(static_cast<std::uint32_t>(cell.y) * across_x +
                                 static_cast<std::uint32_t>(cell.x));
        ++columns.first[columns.column.back() + 1];
    }
    std::partial_sum(columns.first.begin(), columns.first.end(), columns.first.begin());
    std::vector<std::uint32_t> next(columns.first.begin(), columns.first.end() - 1);
    columns.sites.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) columns.sites[next[columns.column[i]]++] = i;
    return columns;
}

/// Returns the height of the highest surface below a site that faces up, in its column; minus infinity for
/// none.
double landing(const Columns& columns, const std::vector<double>& facing, std::uint32_t site) {
    const std::uint32_t column = columns.column[site];
    double height = -infinity;
    for (std::uint32_t k = columns.first[column]; k < columns.first[column + 1]; ++k) {
        const std::uint32_t other = columns.sites[k];
        const double z = columns.places[other].z;
        if (facing[other] > 0 && z < columns.places[site].z) height = std::max(height, z);
    }
    return height;
}

/// Whether a site would be printed in the air though its own surface holds itself: no neighbour below lies
/// within twice the slope that does (sites are too few to tell it exactly). So are the lowest points of tips,
/// and ridges that face down.
bool is_bare(const SurfaceSites& sites, const Columns& columns, std::uint32_t site, double overhang) {
    return std::ranges::none_of(sites.neighbours(site), [&](std::uint32_t other) {
        const dvec3 way = columns.places[other] - columns.places[site];
        if (way.z > 0 || (way.z == 0 && other > site)) return false;
        return dot(dvec2(way), dvec2(way)) <= 4 * overhang * overhang * way.z * way.z;
    });
}

/// Places supports as the survey of layers does: from the lowest site up, each site that is not held gets
/// one, which holds all about it.
class SupportSpread {
  public:
    SupportSpread(const SurfaceSites& sites, double spacing)
        : sites_(sites), square_(spacing * spacing), is_held_(sites.size(), 0) {}

    bool is_held(std::uint32_t site) const { return is_held_[site] != 0; }

    /// Marks what a support at a site holds: the sites within the spacing, from neighbour to neighbour.
    void place(std::uint32_t site) {
        reached_.assign(1, site);
        is_held_[site] = ++stamp_;
        for (std::size_t k = 0; k < reached_.size(); ++k) {
            for (const std::uint32_t other : sites_.neighbours(reached_[k])) {
                const dvec3 way = sites_.places[other] - sites_.places[site];
                if (is_held_[other] == stamp_ || dot(way, way) > square_) continue;
                is_held_[other] = stamp_;
                reached_.push_back(other);
            }
        }
    }

  private:
    const SurfaceSites& sites_;
    double square_;
    std::uint32_t stamp_ = 0;
    std::vector<std::uint32_t> is_held_;  ///< by site: the last support that holds it; 0: none
    std::vector<std::uint32_t> reached_;
};

/// Returns the material of a support of this height, mm^3.
double support_volume(const OrientationRules& rules, double height, bool is_on_bed) {
    const double tip = std::min(height, rules.connector), pillar = height - tip;
    const double foot = is_on_bed && pillar > 0 ? std::min(pillar / rules.foot_width, 1.0) : 0;
    return rules.tip_area * tip + rules.pillar_area * pillar + rules.foot_volume * foot;
}

/// Finds the largest section and the largest step from one layer to the next, from the flux through the
/// surface below them.
void measure_sections(const SurfaceCover& cover, const Columns& columns, const std::vector<double>& facing,
                      double layer_height, OrientationFigures& figures) {
    constexpr double most = 1 << 16;
    const double step = std::max(layer_height / 2, (columns.high - columns.low) / most);
    std::vector<double> flux(static_cast<std::size_t>((columns.high - columns.low) / step) + 1);
    for (std::size_t i = 0; i < facing.size(); ++i)
        flux[static_cast<std::size_t>((columns.places[i].z - columns.low) / step)] -=
            cover.areas[i] * facing[i];
    double area = 0;
    for (std::size_t k = 0; k < flux.size(); ++k) {
        area += flux[k];
        figures.largest_layer = std::max(figures.largest_layer, area);
        // The middles of two layers are two halves apart; the bed and the top are no steps.
        if (k > 1 && k + 2 < flux.size())
            figures.largest_step = std::max(figures.largest_step, std::abs(flux[k - 1] + flux[k]));
    }
}

/// Returns how far inside the hull of the lowest layer a place lies.
double depth_over_bed(const Columns& columns, double layer_height, dvec2 place) {
    std::vector<dvec2> touching;
    for (const dvec3& at : columns.places) {
        if (at.z < columns.low + layer_height) touching.emplace_back(at);
    }
    return depth_in_hull(convex_hull(std::move(touching)), place);
}

double share_across(const std::vector<dvec3>& loads, dvec3 up) {
    double along = 0, total = 0;
    for (const dvec3& load : loads) {
        along += std::abs(dot(load, up));
        total += length(load);
    }
    return total > 0 ? along / total : 0;
}

}  // namespace

std::pair<dvec3, dvec3> across(dvec3 n) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {dvec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), dvec3(b, sign + n.y * n.y * a, -n.y)};
}

OrientationFigures orientation_figures(const SurfaceCover& cover, dvec3 up, const OrientationRules& rules) {
    const SurfaceSites& sites = cover.sites;
    const Columns columns = columns_of(cover, up);
    std::vector<double> facing;
    facing.reserve(sites.size());
    for (const dvec3& normal : sites.normals) facing.push_back(dot(normal, up));
    OrientationFigures figures;
    figures.up = up;
    figures.height = columns.high - columns.low;
    const double bed = columns.low - rules.lift;
    // A surface whose normal is this far below the horizon stands out too far over the layer below.
    constexpr double upright = -0.05;
    const double limit = -rules.overhang / std::sqrt(1 + rules.overhang * rules.overhang);
    std::vector<std::pair<double, std::uint32_t>> bare;
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
        const double height = columns.places[i].z;
        const bool hangs = facing[i] < limit;
        if (height < bed + rules.layer_height) {
            if (hangs) figures.bed_area += cover.areas[i];
            continue;
        }
        if (hangs) figures.overhang_area += cover.areas[i];
        // The lowest point of an upright wall is the rim of what is below it.
        if (hangs || (facing[i] < upright && is_bare(sites, columns, i, rules.overhang)))
            bare.emplace_back(height, i);
    }
    std::ranges::sort(bare);
    SupportSpread spread(sites, rules.spacing);
    for (const auto& [height, site] : bare) {
        if (spread.is_held(site)) continue;
        spread.place(site);
        const double below = landing(columns, facing, site);
        const bool is_on_bed = below < bed;
        figures.support_volume += support_volume(rules, height - (is_on_bed ? bed : below), is_on_bed);
    }
    measure_sections(cover, columns, facing, rules.layer_height, figures);
    const auto [a, b] = across(up);
    figures.stands =
        depth_over_bed(columns, rules.layer_height, {dot(cover.centroid, a), dot(cover.centroid, b)});
    figures.load_across = share_across(rules.loads, up);
    return figures;
}

}  // namespace lamella
