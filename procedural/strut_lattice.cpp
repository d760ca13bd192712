// The lattice as a field: settings checked, struts made into beams, distances through bricks.
#include "procedural/strut_lattice.h"

#include <fmt/format.h>

#include <array>

#include "engine/beam_slice.h"
#include "engine/error.h"
#include "engine/slice_context.h"
#include "procedural/beam_box.h"
#include "procedural/grading_quotient.h"

namespace lamella {
namespace {

constexpr double most_beams_per_slice = 5e7;
constexpr double most_cells_per_side = 1e6;
constexpr double most_bend = 0.02;  // of a radius, between a beam and the grading along it
constexpr int most_splits = 5;      // into 32 beams

bool finite(dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Keeps the radius to what the region asks for.
LatticeSettings checked(const LatticeSettings& settings) {
    check_unit_cell(settings.struts);
    if (!settings.cell || !settings.beam) throw InputError("the lattice needs a cell size and a beam radius");
    const Box& region = settings.region;
    if (region.empty() || !finite(region.lo) || !finite(region.hi)) {
        throw InputError("the lattice's region is empty or not finite; give a box with finite corners");
    }
    positive_range(*settings.cell, region, "the lattice's cell size");
    const Interval radii = positive_range(*settings.beam, region, "the lattice's beam radius");
    const double thickest = tight_range(*make_quotient_grading(settings.beam, settings.cell), region).hi;
    if (!(thickest < 0.5)) {
        throw InputError(
            fmt::format("the lattice's beam radius goes up to {:.4g} of its cell size, which fills "
                        "the cells; it must be less than half",
                        thickest));
    }
    LatticeSettings result = settings;
    result.beam = make_clamped_grading(settings.beam, radii);
    return result;
}

void check_count(const LatticeSettings& settings, const LatticeStruts& struts) {
    const double least = struts.cells().side(struts.cells().levels());
    const dvec3 cells = settings.region.size() / least;
    const double beams = (cells.x + 1) * (cells.y + 1) * static_cast<double>(struts.per_cell());
    const double longest = std::max(cells.x, std::max(cells.y, cells.z));
    if (beams <= most_beams_per_slice && longest <= most_cells_per_side) return;
    throw InputError(
        fmt::format("a layer of the lattice could cut {:.3g} beams of cells of {:.4g} mm, {:.0f} cells along "
                    "the longest side; accepted: at most {:.0f} beams and {:.0f} cells, with larger cells or "
                    "a smaller region",
                    beams, least, longest, most_beams_per_slice, most_cells_per_side));
}

dvec3 between(const Beam& beam, double t) { return beam.a + (beam.b - beam.a) * t; }

}  // namespace

StrutLattice::StrutLattice(const LatticeSettings& settings)
    : settings_(checked(settings)),
      struts_(std::make_shared<const LatticeStruts>(
          std::make_shared<const CellOctree>(settings.cell, settings.region, settings.cache_bytes),
          settings.struts)),
      bricks_(settings.cache_bytes) {
    check_count(settings_, *struts_);
    const Interval radii = settings_.beam->range(settings_.region);
    constant_radius_ = radii.lo == radii.hi;
    greatest_radius_ = radii.hi;
}

StrutLattice::StrutLattice(const StrutLattice& thinner, double growth)
    : Field(),
      settings_(thinner.settings_),
      struts_(thinner.struts_),
      constant_radius_(thinner.constant_radius_),
      growth_(thinner.growth_ + growth),
      greatest_radius_(thinner.greatest_radius_ + growth),
      bricks_(thinner.settings_.cache_bytes) {
    settings_.region = grown(settings_.region, growth);
}

double StrutLattice::radius_at(dvec3 p) const {
    const Box& graded = cells().region();
    return settings_.beam->at(glm::clamp(p, graded.lo, graded.hi)) + growth_;
}

/// Appends the beam, or parts of it where the radius bends, as far as they touch the box.
void StrutLattice::append(const Beam& beam, int splits, const Box& box, std::vector<Beam>& beams) const {
    if (!constant_radius_ && splits < most_splits) {
        std::array<double, 3> radii;
        bool bends = false;
        for (std::size_t i = 0; i < radii.size(); ++i) {
            const double t = static_cast<double>(i + 1) / 4;
            radii[i] = radius_at(between(beam, t));
            bends |= std::abs(radii[i] - (beam.ra + (beam.rb - beam.ra) * t)) > most_bend * radii[i];
        }
        if (bends) {
            const dvec3 middle = between(beam, 0.5);
            append({beam.a, beam.ra, middle, radii[1]}, splits + 1, box, beams);
            append({middle, radii[1], beam.b, beam.rb}, splits + 1, box, beams);
            return;
        }
    }
    if (touches(beam, box)) beams.push_back(beam);
}

std::vector<Beam> StrutLattice::beams_touching(const Box& box) const {
    std::vector<Beam> beams;
    if (box.empty()) return beams;
    for (const GridStrut& strut : struts_->meeting(grown(box, greatest_radius_))) {
        const dvec3 a = struts_->position(strut.a), b = struts_->position(strut.b);
        append({a, radius_at(a), b, radius_at(b)}, 0, box, beams);
    }
    return beams;
}

double StrutLattice::value(dvec3 p) const {
    const dvec3 away = glm::abs(p - cells().origin());
    const double reach = CellOctree::farthest * cells().coarse_side();
    if (!(std::max(away.x, std::max(away.y, away.z)) < reach) || !finite(p)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const OctreeCell cell = cells().cell_at(p);
    const PlaceKey key{cell.index.x, cell.index.y, cell.index.z, cell.level, 0};
    const auto brick = bricks_.find_or_make(key, p.z, [&] {
        return DistanceBrick(cells().box(cell), [this](const Box& box) { return beams_touching(box); });
    });
    return brick->distance(p);
}

Interval StrutLattice::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, a beam's axis is the deepest place.
    const double radius = glm::length(box.hi - center);
    return {std::max(center_value - radius, -greatest_radius_), center_value + radius};
}

FieldPtr StrutLattice::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    return FieldPtr(new StrutLattice(*this, d));
}

const SliceField& StrutLattice::slice(SliceContext& context, double z) const {
    const Box& region = settings_.region;
    return context.make<BeamSlice>(
        *this, beams_touching({{region.lo.x, region.lo.y, z}, {region.hi.x, region.hi.y, z}}), z);
}

std::shared_ptr<const StrutLattice> make_strut_lattice(const LatticeSettings& settings) {
    return std::make_shared<const StrutLattice>(settings);
}

}  // namespace lamella
