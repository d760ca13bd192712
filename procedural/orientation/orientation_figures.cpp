// One pass over the points of the surface, in columns along the direction.
#include "procedural/orientation/orientation_figures.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/base/error.h"
#include "procedural/texture/body_sites.h"

namespace lamella {

namespace {

/// A point of the surface in the direction's own axes.
struct ColumnPoint {
    std::int64_t x, y;  ///< of its column
    double height;      ///< mm
    std::uint32_t site;
};

/// Returns the points by column, each from below.
std::vector<ColumnPoint> columns_of(const SurfaceCover& cover, dvec3 up) {
    const SurfaceSites& sites = cover.sites;
    // Wide enough that no column of a smooth surface is without a point.
    const double width = 2 * sites.spacing;
    const auto [a, b] = across(up);
    std::vector<ColumnPoint> points(sites.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const dvec3 p = sites.places[i];
        points[i] = {static_cast<std::int64_t>(std::floor(dot(p, a) / width)),
                     static_cast<std::int64_t>(std::floor(dot(p, b) / width)), dot(p, up), i};
    }
    std::ranges::sort(points, {},
                      [](const ColumnPoint& p) { return std::tuple(p.y, p.x, p.height, p.site); });
    return points;
}

/// Whether no neighbour on the surface is lower.
bool is_lowest(const SurfaceSites& sites, std::uint32_t site, dvec3 up) {
    const double height = dot(sites.places[site], up);
    return std::ranges::none_of(sites.neighbours(site), [&](std::uint32_t other) {
        return std::pair(dot(sites.places[other], up), other) < std::pair(height, site);
    });
}

/// Returns the material of a support of this height, mm^3.
double support_volume(const OrientationRules& rules, double height, bool is_on_bed) {
    const double tip = std::min(height, rules.connector), pillar = height - tip;
    const double foot = is_on_bed && pillar > 0 ? std::min(pillar / rules.foot_width, 1.0) : 0;
    return rules.tip_area * tip + rules.pillar_area * pillar + rules.foot_volume * foot;
}

/// Returns the area of the largest section, from the flux through the surface below it.
double largest_section(const SurfaceCover& cover, dvec3 up) {
    const SurfaceSites& sites = cover.sites;
    std::vector<std::pair<double, double>> flux(sites.size());
    for (std::size_t i = 0; i < flux.size(); ++i)
        flux[i] = {dot(sites.places[i], up), -cover.areas[i] * dot(sites.normals[i], up)};
    std::ranges::sort(flux);
    double area = 0, largest = 0;
    for (const auto& [height, through] : flux) {
        area += through;
        largest = std::max(largest, area);
    }
    return largest;
}

}  // namespace

std::pair<dvec3, dvec3> across(dvec3 n) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {dvec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), dvec3(b, sign + n.y * n.y * a, -n.y)};
}

SurfaceCover cover_surface(const Field& body, std::size_t sites, const CancelToken* cancel) {
    const dvec3 size = body.bounds().size();
    const double area = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
    SurfaceCover cover;
    double spacing = std::sqrt(1.5 * area / static_cast<double>(sites));
    // A body with much more surface than its box has is covered more coarsely.
    for (;;) {
        cover.sites = sites_on_surface(body, spacing, 8 * sites, cancel);
        if (cover.sites.size() <= 2 * sites) break;
        spacing *= std::sqrt(static_cast<double>(cover.sites.size()) / static_cast<double>(sites));
    }
    cover.areas.reserve(cover.sites.size());
    // A plane has one foot for each square of the spacing, seen along the axis that it faces most.
    for (const dvec3& normal : cover.sites.normals) {
        const dvec3 n = glm::abs(normal);
        cover.areas.push_back(spacing * spacing * std::max({n.x, n.y, n.z}));
    }
    return cover;
}

OrientationFigures orientation_figures(const SurfaceCover& cover, dvec3 up, const OrientationRules& rules) {
    const SurfaceSites& sites = cover.sites;
    OrientationFigures figures;
    figures.up = up;
    const std::vector<ColumnPoint> points = columns_of(cover, up);
    double low = infinity, high = -infinity;
    for (const ColumnPoint& point : points) {
        low = std::min(low, point.height);
        high = std::max(high, point.height);
    }
    figures.height = high - low;
    const double bed = low - rules.lift;
    // A surface whose normal is this far below the horizon stands out too far over the layer below.
    constexpr double upright = -0.05;
    const double limit = -rules.overhang / std::sqrt(1 + rules.overhang * rules.overhang);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ColumnPoint& point = points[i];
        const double facing = dot(sites.normals[point.site], up), area = cover.areas[point.site];
        if (point.height < bed + rules.layer_height) {
            if (facing < limit) figures.bed_area += area;
            continue;
        }
        const bool hangs = facing < limit;
        // The lowest point of a steep tip is held, too; that of an upright wall is the rim of what is below
        // it.
        if (!hangs && !(facing < upright && is_lowest(sites, point.site, up))) continue;
        if (hangs) figures.overhang_area += area;
        double landing = bed;
        bool is_on_bed = true;
        for (std::size_t k = i; k-- > 0 && points[k].x == point.x && points[k].y == point.y;) {
            if (!(dot(sites.normals[points[k].site], up) > 0)) continue;
            landing = points[k].height;
            is_on_bed = false;
            break;
        }
        figures.support_volume += (hangs ? area / (rules.spacing * rules.spacing) : 1) *
                                  support_volume(rules, point.height - landing, is_on_bed);
    }
    figures.largest_layer = largest_section(cover, up);
    return figures;
}

}  // namespace lamella
