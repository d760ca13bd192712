// Checks walls and windows, and assembles the foam with walls.
#include "procedural/foam/closed_foam.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/field/turned_grading.h"

namespace lamella {
namespace {

constexpr double max_wall_share = 0.9;  // share of the local cell

/// Half a wall's thickness, limited by the local cell size.
class HalfWall : public Grading {
  public:
    HalfWall(GradingPtr wall, GradingPtr cell) : wall_(std::move(wall)), cell_(std::move(cell)) {}
    double at(dvec3 p) const override { return half(wall_->at(p), cell_->at(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*wall_, *cell_, points, out, half);
    }
    Interval range(const Box& box) const override {
        const Interval wall = wall_->range(box), cell = cell_->range(box);
        return {half(wall.lo, cell.lo), half(wall.hi, cell.hi)};
    }

  private:
    static double half(double wall, double cell) { return 0.5 * std::min(wall, max_wall_share * cell); }

    GradingPtr wall_, cell_;
};

/// Returns the range of a graded setting over the region, clamped to `limits`. Throws InputError if a
/// constant is outside them.
Interval range_within(const Graded& graded, const Box& region, Interval limits, const char* what,
                      const char* limits_in_words) {
    const Interval range = tight_range(*graded, region);
    const bool refused = graded->constant() && !(limits.lo <= range.lo && range.hi <= limits.hi);
    if (refused || !std::isfinite(range.lo) || !std::isfinite(range.hi)) {
        throw InputError(fmt::format("{} is {}; it must be {}", what,
                                     std::isfinite(range.lo) ? range.hi : range.lo, limits_in_words));
    }
    return {std::min(std::max(range.lo, limits.lo), limits.hi),
            std::min(std::max(range.hi, limits.lo), limits.hi)};
}

NodeRadius wall_radius(const ClosedFoamSettings& settings, const FoamSeeding& ground) {
    const Interval walls = range_within(settings.wall, settings.foam.region, {0, infinity},
                                        "the foam's wall thickness in mm", "finite and at least 0");
    const bool constant = settings.wall->constant().has_value();
    if (constant && walls.lo > max_wall_share * ground.cells.hi) {
        throw InputError(fmt::format(
            "the foam's wall thickness of {} mm fills its cells of {} mm; it must be at most {:.4g} mm",
            walls.lo, ground.cells.hi, max_wall_share * ground.cells.hi));
    }
    if (constant && walls.lo <= max_wall_share * ground.cells.lo) return NodeRadius(walls.lo / 2);
    const GradingPtr wall =
        make_turned_grading(make_clamped_grading(settings.wall.pointer(), walls), settings.foam.turn.axes);
    return {std::make_shared<HalfWall>(wall, ground.cell),
            0.5 * std::min(walls.hi, max_wall_share * ground.cells.hi)};
}

Graded window_share(const ClosedFoamSettings& settings) {
    const Interval shares =
        range_within(settings.window, settings.foam.region, {0, 1},
                     "the share of the foam's walls that is window", "from 0 (closed) to 1 (no wall)");
    return make_turned_grading(make_clamped_grading(settings.window.pointer(), shares),
                               settings.foam.turn.axes);
}

}  // namespace

ClosedFoam::ClosedFoam(const ClosedFoamSettings& settings)
    : ClosedFoam(settings, prepare_foam(settings.foam)) {}

ClosedFoam::ClosedFoam(const ClosedFoamSettings& settings, const FoamSeeding& ground)
    : ClosedFoam(settings.foam.turned_region(), ground,
                 {wall_radius(settings, ground), window_share(settings), 0}, settings.foam.cache_bytes) {}

ClosedFoam::ClosedFoam(const Box& region, const FoamSeeding& ground, const WallSettings& walls,
                       std::size_t cache_bytes)
    : PieceFoam(region, ground.cell, ground.cells,
                std::max(ground.largest_radius(), walls.radius.largest() + walls.growth), cache_bytes),
      ground_(ground),
      walls_(walls),
      cache_bytes_(cache_bytes),
      units_(ground.tree,
             FramedMaker<WallMaker>(WallMaker(BeamMaker(ground.radius, ground.stretch), walls), ground.frame),
             cache_bytes) {}

FieldPtr ClosedFoam::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    const FoamSeeding ground = ground_.grown(d);
    WallSettings walls = walls_;
    walls.growth += d;
    return FieldPtr(new ClosedFoam(grown(bounds(), d), ground, walls, cache_bytes_));
}

std::shared_ptr<const ClosedFoam> make_closed_foam(const ClosedFoamSettings& settings) {
    return std::make_shared<const ClosedFoam>(settings);
}

}  // namespace lamella
