// The foam as a field: settings checked, distances through bricks, slices through units.
#include "procedural/voronoi_foam.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/beam_slice.h"
#include "engine/error.h"
#include "engine/slice_context.h"

namespace lamella {
namespace {

// With four cells along a coarse cell, the counts come out as 64 a coarse cell and 8 a leaf: one seed per
// cell^3, each in its own cube of side `cell`.
constexpr double cells_per_coarse_side = 4;
constexpr double most_cells_per_slice = 1e8;

bool finite(dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void check(const FoamSettings& settings) {
    const double cell = settings.cell, radius = settings.beam_radius;
    if (!(cell > 0) || !std::isfinite(cell)) {
        throw InputError(fmt::format("the foam's cell size is {} mm; it must be positive", cell));
    }
    if (!(radius > 0) || !std::isfinite(radius)) {
        throw InputError(fmt::format("the foam's beam radius is {} mm; it must be positive", radius));
    }
    if (radius >= cell / 2) {
        throw InputError(fmt::format(
            "the foam's beam radius of {} mm fills its cells of {} mm; it must be less than {} mm", radius,
            cell, cell / 2));
    }
    if (settings.region.empty() || !finite(settings.region.lo) || !finite(settings.region.hi)) {
        throw InputError("the foam's region is empty or not finite; give a box with finite corners");
    }
    const dvec3 cells = settings.region.size() / cell;
    if (!(cells.x * cells.y <= most_cells_per_slice)) {
        throw InputError(
            fmt::format("a layer of the foam would cut {:.0f} cells; with a region of {} x {} mm the "
                        "cell size must be at least {:.4g} mm",
                        cells.x * cells.y, settings.region.size().x, settings.region.size().y,
                        cell * std::sqrt(cells.x * cells.y / most_cells_per_slice)));
    }
}

std::shared_ptr<const SeedTree> make_tree(const FoamSettings& settings) {
    check(settings);
    const double cell = settings.cell;
    return std::make_shared<const SeedTree>(std::make_shared<const ConstantDensity>(1 / (cell * cell * cell)),
                                            cells_per_coarse_side * cell, settings.seed);
}

}  // namespace

VoronoiFoam::VoronoiFoam(const FoamSettings& settings) : VoronoiFoam(settings, make_tree(settings)) {}

VoronoiFoam::VoronoiFoam(const FoamSettings& settings, std::shared_ptr<const SeedTree> tree)
    : settings_(settings),
      tree_(std::move(tree)),
      units_(
          std::make_shared<const FoamUnits>(tree_, NodeRadius(settings.beam_radius), settings.cache_bytes)),
      bricks_(settings.cache_bytes) {}

double VoronoiFoam::value(dvec3 p) const {
    if (!finite(p)) return std::numeric_limits<double>::quiet_NaN();
    const double side = settings_.cell;
    const dvec3 index = glm::floor(p / side);
    tree_->block_index(p);
    const PlaceKey key{static_cast<std::int64_t>(index.x), static_cast<std::int64_t>(index.y),
                       static_cast<std::int64_t>(index.z), 0, 0};
    const auto brick = bricks_.find_or_make(key, p.z, [&] {
        return DistanceBrick({index * side, (index + 1.0) * side},
                             [this](const Box& box) { return beams_touching(box); });
    });
    return brick->distance(p);
}

Interval VoronoiFoam::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, a beam's axis is the deepest place.
    const double radius = glm::length(box.hi - center);
    return {std::max(center_value - radius, -settings_.beam_radius), center_value + radius};
}

FieldPtr VoronoiFoam::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    FoamSettings thicker = settings_;
    thicker.beam_radius += d;
    thicker.region = grown(settings_.region, d);
    return FieldPtr(new VoronoiFoam(thicker, tree_));
}

const SliceField& VoronoiFoam::slice(SliceContext& context, double z) const {
    return context.make<BeamSlice>(*this, beams_at(z), z);
}

std::vector<Beam> VoronoiFoam::beams_at(double z) const {
    const Box& region = settings_.region;
    return beams_touching({{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z}});
}

double VoronoiFoam::expected_volume_fraction() const {
    constexpr double law_end = 0.15, table_t = 0.20, table_fraction = 0.428;
    const auto law = [](double t) { return t * t * (18.0 - 38.0 * t); };
    const double t = settings_.beam_radius / settings_.cell;
    if (t <= law_end) return law(t);
    const double slope = (table_fraction - law(law_end)) / (table_t - law_end);
    return std::min(law(law_end) + slope * (t - law_end), 1.0);
}

std::shared_ptr<const VoronoiFoam> make_voronoi_foam(const FoamSettings& settings) {
    return std::make_shared<const VoronoiFoam>(settings);
}

}  // namespace lamella
