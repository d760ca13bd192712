// The foam as a field: distances through bricks, slices through units.
#include "procedural/voronoi_foam.h"

#include <cmath>

#include "engine/slice_context.h"
#include "procedural/beam_strips.h"

namespace lamella {
namespace {

constexpr double cells_per_strip = 8192;
constexpr double most_strips = 256;

bool finite(dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

VoronoiFoam::VoronoiFoam(const FoamSettings& settings) : VoronoiFoam(settings, prepare_foam(settings)) {}

VoronoiFoam::VoronoiFoam(const FoamSettings& settings, FoamGround ground)
    : settings_(settings),
      ground_(std::move(ground)),
      units_(std::make_shared<const CellUnits<BeamMaker>>(
          ground_.tree, BeamMaker(ground_.radius, settings.stretch), settings.cache_bytes)),
      bricks_(settings.cache_bytes) {}

double VoronoiFoam::value(dvec3 p) const {
    if (!finite(p)) return std::numeric_limits<double>::quiet_NaN();
    ground_.tree->block_index(settings_.stretch.to_seeds(p));
    const auto [level, side] = brick_size(p);
    const dvec3 index = glm::floor(p / side);
    const PlaceKey key{static_cast<std::int64_t>(index.x), static_cast<std::int64_t>(index.y),
                       static_cast<std::int64_t>(index.z), level, 0};
    const auto brick = bricks_.find_or_make(key, p.z, [&] {
        return DistanceBrick({index * side, (index + 1.0) * side},
                             [this](const Box& box) { return beams_touching(box); });
    });
    return brick->distance(p);
}

/// Any brick about the point is exact; one no larger than twice the smallest cell about it is quick to make
/// and to ask.
VoronoiFoam::BrickSize VoronoiFoam::brick_size(dvec3 p) const {
    const Interval& cells = ground_.cells;
    BrickSize size{0, cells.hi};
    while (size.side > cells.lo) {
        const dvec3 lo = glm::floor(p / size.side) * size.side;
        if (size.side <= 2 * ground_.cell->range(lamella::grown(Box{lo, lo + size.side}, size.side)).lo)
            break;
        size = {size.level + 1, size.side / 2};
    }
    return size;
}

Interval VoronoiFoam::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, a beam's axis is the deepest place.
    const double radius = glm::length(box.hi - center);
    return {std::max(center_value - radius, -ground_.radius.largest()), center_value + radius};
}

FieldPtr VoronoiFoam::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    FoamSettings thicker = settings_;
    thicker.region = grown(settings_.region, d);
    FoamGround ground = ground_;
    ground.radius = ground_.radius.grown(d);
    return FieldPtr(new VoronoiFoam(thicker, std::move(ground)));
}

const SliceField& VoronoiFoam::slice(SliceContext& context, double z) const {
    const Rect region = settings_.region.rect();
    const dvec2 cells = region.size() / ground_.cells.lo;
    const double strips = std::floor(std::min(cells.x * cells.y / cells_per_strip, most_strips));
    return context.make<BeamStrips>(
        *this, [this](const Box& box) { return beams_touching(box); }, region,
        std::max(static_cast<int>(strips), 1), z);
}

std::vector<Beam> VoronoiFoam::beams_at(double z) const {
    const Box& region = settings_.region;
    return beams_touching({{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z}});
}

std::vector<Seed> VoronoiFoam::seeds_in(const Box& box) const {
    std::vector<Seed> seeds = ground_.tree->seeds_in(settings_.stretch.to_seeds(box));
    if (settings_.stretch.identity()) return seeds;
    for (Seed& seed : seeds) seed.position = settings_.stretch.to_part(seed.position);
    std::erase_if(seeds, [&](const Seed& seed) { return !box.contains(seed.position); });
    return seeds;
}

double VoronoiFoam::expected_volume_fraction(dvec3 p) const {
    constexpr double law_end = 0.15, table_t = 0.20, table_fraction = 0.428;
    const auto law = [](double t) { return t * t * (18.0 - 38.0 * t); };
    const double t = ground_.radius.at(p) / ground_.cell->at(p);
    if (t <= law_end) return law(t);
    const double slope = (table_fraction - law(law_end)) / (table_t - law_end);
    return std::min(law(law_end) + slope * (t - law_end), 1.0);
}

std::shared_ptr<const VoronoiFoam> make_voronoi_foam(const FoamSettings& settings) {
    return std::make_shared<const VoronoiFoam>(settings);
}

}  // namespace lamella
