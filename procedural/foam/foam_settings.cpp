// Checks a foam's settings, and chooses the coarse cells for its cell sizes.
#include "procedural/foam/foam_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/field/turned_grading.h"
#include "procedural/voronoi/graded_density.h"

namespace lamella {
namespace {

// With four cells along a coarse cell, there are 64 seeds per coarse cell and 8 per leaf: one seed per
// cell^3, each in its own cube of side `cell`. If sizes vary, a coarse side of two of the largest cells means
// less far-away work, and every coarse cell still expects 8 seeds.
constexpr double cells_per_coarse_side = 4, graded_cells_per_coarse_side = 2;
constexpr double bcc_side = 1.2599210498948732;  // side of a cube that contains two cells, in cells
constexpr double max_cells_per_slice = 1e8;
constexpr double max_variation = 40;
constexpr double max_beam_share = 0.45;  // share of the local cell

/// The radius, limited to the share of the local cell that leaves an opening.
class RadiusWithinCells : public Grading {
  public:
    RadiusWithinCells(GradingPtr radius, GradingPtr cell)
        : radius_(std::move(radius)), cell_(std::move(cell)) {}
    double at(dvec3 p) const override { return within(radius_->at(p), cell_->at(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*radius_, *cell_, points, out, within);
    }
    Interval range(const Box& box) const override {
        const Interval radius = radius_->range(box), cell = cell_->range(box);
        return {within(radius.lo, cell.lo), within(radius.hi, cell.hi)};
    }

  private:
    static double within(double radius, double cell) { return std::min(radius, max_beam_share * cell); }

    GradingPtr radius_, cell_;
};

/// The frame's radius, but at least that of the foam's beams.
class RadiusOverBeams : public Grading {
  public:
    RadiusOverBeams(GradingPtr frame, NodeRadius beams)
        : frame_(std::move(frame)), beams_(std::move(beams)) {}
    double at(dvec3 p) const override { return std::max(frame_->at(p), beams_.at(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*frame_, beams_.grading(), points, out,
                   [](double frame, double beams) { return std::max(frame, beams); });
    }
    Interval range(const Box& box) const override {
        const Interval frame = frame_->range(box), beams = beams_.range(box);
        return {std::max(frame.lo, beams.lo), std::max(frame.hi, beams.hi)};
    }

  private:
    GradingPtr frame_;
    NodeRadius beams_;
};

/// A grading of part space, evaluated at points of seed space.
class AmongSeeds : public Grading {
  public:
    AmongSeeds(GradingPtr grading, const Stretch& stretch)
        : grading_(std::move(grading)), stretch_(stretch) {}
    double at(dvec3 p) const override { return grading_->at(stretch_.to_part(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        std::vector<dvec3> places;
        places.reserve(points.size());
        for (const dvec3& p : points) places.push_back(stretch_.to_part(p));
        grading_->numbers(places, out);
    }
    Interval range(const Box& box) const override { return grading_->range(stretch_.to_part(box)); }

  private:
    GradingPtr grading_;
    Stretch stretch_;
};

void check_region(const Box& region, double smallest_cell) {
    if (region.empty() || !is_finite(region.lo) || !is_finite(region.hi)) {
        throw InputError("the foam's region is empty or not finite; give a box with finite corners");
    }
    const dvec3 size = region.size(), cells = size / smallest_cell;
    if (!(cells.x * cells.y <= max_cells_per_slice)) {
        throw InputError(
            fmt::format("a layer of the foam would cut {:.0f} cells; with a region of {} x {} mm the "
                        "cell size must be at least {:.4g} mm",
                        cells.x * cells.y, size.x, size.y,
                        smallest_cell * std::sqrt(cells.x * cells.y / max_cells_per_slice)));
    }
}

NodeRadius node_radius(const FoamSettings& settings, const GradingPtr& cell, const Interval& cells) {
    const Interval radii = positive_range(*settings.beam_radius, settings.region, "the foam's beam radius");
    const bool constant = settings.beam_radius->constant().has_value();
    if (constant && cells.lo == cells.hi && radii.lo >= cells.lo / 2) {
        throw InputError(fmt::format(
            "the foam's beam radius of {} mm fills its cells of {} mm; it must be less than {} mm", radii.lo,
            cells.lo, cells.lo / 2));
    }
    if (constant && (cells.lo == cells.hi || radii.lo <= max_beam_share * cells.lo))
        return NodeRadius(radii.lo);
    return {std::make_shared<RadiusWithinCells>(make_clamped_grading(settings.beam_radius.pointer(), radii),
                                                cell),
            std::min(radii.hi, max_beam_share * cells.hi)};
}

std::optional<SurfaceFrame> surface_frame(const FoamSettings& settings, const NodeRadius& beams) {
    if (!settings.frame) return std::nullopt;
    const FrameSettings& frame = *settings.frame;
    const Interval radii = positive_range(*frame.radius, settings.region, "the frame's beam radius");
    const double largest = std::max(radii.hi, beams.largest());
    const bool constant = frame.radius->constant() && (beams.constant() || beams.largest() <= radii.lo);
    const NodeRadius radius =
        constant ? NodeRadius(largest)
                 : NodeRadius(std::make_shared<RadiusOverBeams>(
                                  make_turned_grading(make_clamped_grading(frame.radius.pointer(), radii),
                                                      settings.turn.axes),
                                  beams),
                              largest);
    return SurfaceFrame(frame.body, radius, frame.interior);
}

}  // namespace

FoamSeeding FoamSeeding::grown(double by) const {
    FoamSeeding thicker = *this;
    thicker.radius = radius.grown(by);
    if (frame) thicker.frame = frame->grown(by);
    return thicker;
}

FoamSeeding prepare_foam(const FoamSettings& settings) {
    const auto constant_cell = settings.cell->constant();
    if (constant_cell) positive_range(*settings.cell, {dvec3(0), dvec3(1)}, "the foam's cell size");
    check_region(settings.region, constant_cell.value_or(infinity));
    const Interval cells = positive_range(*settings.cell, settings.region, "the foam's cell size");
    check_region(settings.region, cells.lo);
    if (cells.hi > max_variation * cells.lo) {
        throw InputError(
            fmt::format("the foam's cell size varies from {:.4g} to {:.4g} mm; the largest may "
                        "be {} times the smallest: give it limits",
                        cells.lo, cells.hi, max_variation));
    }
    const GradingPtr cell = make_clamped_grading(settings.cell.pointer(), cells);
    std::shared_ptr<const Density> density;
    if (cells.lo == cells.hi) {
        density = std::make_shared<const ConstantDensity>(1 / (cells.lo * cells.lo * cells.lo));
    } else {
        density = std::make_shared<const GradedDensity>(
            settings.stretch.identity() ? cell : std::make_shared<AmongSeeds>(cell, settings.stretch));
    }
    const double coarse = (cells.lo == cells.hi ? cells_per_coarse_side : graded_cells_per_coarse_side) *
                          (settings.pattern == SeedPattern::bcc ? bcc_side : 1);
    const glm::dmat3& axes = settings.turn.axes;
    const NodeRadius radius = node_radius(settings, cell, cells).turned(axes);
    return {std::make_shared<const SeedTree>(std::move(density), coarse * cells.hi, settings.seed,
                                             settings.pattern, settings.jitter, settings.repeats_after),
            make_turned_grading(cell, axes),
            cells,
            radius,
            settings.stretch.turned(axes),
            surface_frame(settings, radius)};
}

std::vector<Seed> FoamSeeding::seeds_in(const Box& box) const {
    std::vector<Seed> seeds = tree->seeds_in(stretch.to_seeds(box));
    if (stretch.identity()) return seeds;
    for (Seed& seed : seeds) seed.position = stretch.to_part(seed.position);
    std::erase_if(seeds, [&](const Seed& seed) { return !box.contains(seed.position); });
    return seeds;
}

}  // namespace lamella
