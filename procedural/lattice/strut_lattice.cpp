// The lattice as a field: checks settings and turns struts into beams.
#include "procedural/lattice/strut_lattice.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "procedural/foam/beam_box.h"
#include "procedural/grading/grading_quotient.h"

namespace lamella {
namespace {

constexpr double max_beams_per_slice = 5e7;
constexpr double max_cells_per_side = 1e6;

/// Checks the settings, and clamps the radius to its range over the region.
LatticeSettings checked(const LatticeSettings& settings) {
    check_unit_cell(settings.struts);
    if (!settings.cell || !settings.beam) throw InputError("the lattice needs a cell size and a beam radius");
    const Box& region = settings.region;
    if (region.empty() || !is_finite(region.lo) || !is_finite(region.hi)) {
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
    if (beams <= max_beams_per_slice && longest <= max_cells_per_side) return;
    throw InputError(
        fmt::format("a layer of the lattice could cut {:.3g} beams of cells of {:.4g} mm, {:.0f} cells along "
                    "the longest side; accepted: at most {:.0f} beams and {:.0f} cells, with larger cells or "
                    "a smaller region",
                    beams, least, longest, max_beams_per_slice, max_cells_per_side));
}

/// A grading that is evaluated at the nearest point of a box.
class WithinBox : public Grading {
  public:
    WithinBox(GradingPtr grading, const Box& box) : grading_(std::move(grading)), box_(box) {}
    double at(dvec3 p) const override { return grading_->at(glm::clamp(p, box_.lo, box_.hi)); }
    Interval range(const Box& box) const override {
        return grading_->range({glm::clamp(box.lo, box_.lo, box_.hi), glm::clamp(box.hi, box_.lo, box_.hi)});
    }

  private:
    GradingPtr grading_;
    Box box_;
};

std::shared_ptr<const LatticeStruts> make_struts(const LatticeSettings& settings) {
    auto struts = std::make_shared<const LatticeStruts>(
        std::make_shared<const CellOctree>(settings.cell, settings.region, settings.cache_bytes),
        settings.struts);
    check_count(settings, *struts);
    return struts;
}

NodeRadius node_radius(const LatticeSettings& settings) {
    const Interval radii = settings.beam->range(settings.region);
    if (radii.lo == radii.hi) return NodeRadius(radii.lo);
    return {std::make_shared<WithinBox>(settings.beam, settings.region), radii.hi};
}

GradingPtr cell_sizes(const LatticeSettings& settings, const CellOctree& cells) {
    return make_clamped_grading(std::make_shared<WithinBox>(settings.cell, cells.region()),
                                {cells.side(cells.levels()), cells.coarse_side()});
}

}  // namespace

StrutLattice::StrutLattice(const LatticeSettings& settings) : StrutLattice(Checked{checked(settings)}) {}

StrutLattice::StrutLattice(const Checked& checked)
    : StrutLattice(checked.settings, make_struts(checked.settings), node_radius(checked.settings)) {}

StrutLattice::StrutLattice(const LatticeSettings& settings, std::shared_ptr<const LatticeStruts> struts,
                           NodeRadius radius)
    : BeamFoam(settings.region, cell_sizes(settings, struts->cells()),
               {struts->cells().side(struts->cells().levels()), struts->cells().coarse_side()},
               radius.largest(), settings.cache_bytes),
      settings_(settings),
      struts_(std::move(struts)),
      radius_(std::move(radius)) {}

std::vector<Beam> StrutLattice::pieces_touching(const Box& box) const {
    std::vector<Beam> beams;
    if (box.empty()) return beams;
    TaperedBeams tapered(radius_);
    for (const GridStrut& strut : struts_->meeting(grown(box, radius_.largest()))) {
        tapered.add(struts_->position(strut.a), struts_->position(strut.b));
    }
    tapered.append(beams);
    std::erase_if(beams, [&](const Beam& part) { return !touches(part, box); });
    return beams;
}

double StrutLattice::value(dvec3 p) const {
    const dvec3 away = glm::abs(p - cells().origin());
    const double reach = CellOctree::farthest * cells().coarse_side();
    if (!(std::max(away.x, std::max(away.y, away.z)) < reach)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    return BeamFoam::value(p);
}

FieldPtr StrutLattice::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    LatticeSettings thicker = settings_;
    thicker.region = grown(settings_.region, d);
    return FieldPtr(new StrutLattice(thicker, struts_, radius_.grown(d)));
}

std::shared_ptr<const StrutLattice> make_strut_lattice(const LatticeSettings& settings) {
    return std::make_shared<const StrutLattice>(settings);
}

}  // namespace lamella
