// Assembles the Voronoi foam from seeds, cells and beams.
#include "procedural/foam/voronoi_foam.h"

#include <cmath>

namespace lamella {

VoronoiFoam::VoronoiFoam(const FoamSettings& settings) : VoronoiFoam(settings, prepare_foam(settings)) {}

VoronoiFoam::VoronoiFoam(const FoamSettings& settings, FoamSeeding ground)
    : BeamFoam(settings.turned_region(), ground.cell, ground.cells, ground.largest_radius(),
               settings.cache_bytes),
      settings_(settings),
      ground_(std::move(ground)),
      units_(std::make_shared<const CellUnits<FramedMaker<BeamMaker>>>(
          ground_.tree, FramedMaker<BeamMaker>(BeamMaker(ground_.radius, ground_.stretch), ground_.frame),
          settings.cache_bytes)) {}

FieldPtr VoronoiFoam::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    FoamSettings thicker = settings_;
    thicker.region = grown(settings_.region, d);
    if (!thicker.turn.identity()) thicker.turn.region = grown(settings_.turn.region, d);
    return FieldPtr(new VoronoiFoam(thicker, ground_.grown(d)));
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
