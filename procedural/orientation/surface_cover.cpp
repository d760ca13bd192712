// Sites of the body, the share of the surface that each stands for, and the centroid from the flux of x^2
// / 2.
#include "procedural/orientation/surface_cover.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"
#include "procedural/texture/body_sites.h"

namespace lamella {

namespace {

/// Returns the centroid of a body from its runs, a hundredth of its longest side apart.
dvec3 centroid_of(const Field& body) {
    const Box box = body.bounds();
    const dvec3 size = box.size();
    const double pitch = std::max({size.x, size.y, size.z}) / 100;
    RowBand band;
    band.along_origin = box.lo.x;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(std::ceil(size.y / pitch));
    // Rows and planes lie evenly in the box.
    band.across_origin = box.lo.y + (size.y - band.count * pitch) / 2;
    band.hi = static_cast<int>(size.x / pitch) + 1;
    const int planes = static_cast<int>(std::ceil(size.z / pitch));
    std::vector<std::pair<double, dvec3>> parts(static_cast<std::size_t>(planes));  // volume and moment
    parallel_for(planes, [&](int i) {
        SliceContext context;
        Scratch scratch;
        const auto rows = scratch.rows();
        const double z = box.lo.z + size.z * (i + 0.5) / planes;
        context.slice(body, z).runs(band, scratch, *rows);
        auto& [volume, moment] = parts[static_cast<std::size_t>(i)];
        for (int row = 0; row < band.count; ++row) {
            for (const Run& run : rows->line(static_cast<std::size_t>(row))) {
                const dvec2 from = on_band(band, run.begin, row), to = on_band(band, run.end, row);
                const dvec3 middle(0.5 * (from.x + to.x), from.y + pitch / 2, z);
                volume += to.x - from.x;
                moment += (to.x - from.x) * middle;
            }
        }
    });
    double volume = 0;
    dvec3 moment(0);
    for (const auto& [part, of_part] : parts) {
        volume += part;
        moment += of_part;
    }
    return volume > 0 ? moment / volume : box.center();
}

}  // namespace

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
    cover.centroid = centroid_of(body);
    return cover;
}

}  // namespace lamella
