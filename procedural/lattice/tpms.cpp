// The periodic solids as fields: checks settings, computes values and ranges from g, and makes slices.
#include "procedural/lattice/tpms.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "procedural/grading/grading_quotient.h"
#include "procedural/lattice/tpms_slice.h"

namespace lamella {
namespace {

constexpr double max_periods = 10'000;

const char* name_of(TpmsKind kind) {
    switch (kind) {
        case TpmsKind::gyroid:
            return "gyroid";
        case TpmsKind::schwarz_p:
            return "Schwarz P surface";
        case TpmsKind::schwarz_d:
            return "Schwarz D surface";
        case TpmsKind::neovius:
            break;
    }
    return "Neovius surface";
}

/// Checks the settings. Clamps the gradings to their ranges over the region, so that the solid is defined in
/// all of space.
TpmsSettings checked(const TpmsSettings& settings) {
    const char* name = name_of(settings.kind);
    const Box& region = settings.region;
    if (!settings.period || !settings.thickness) {
        throw InputError(fmt::format("the {} needs a period and a thickness", name));
    }
    if (region.empty() || !is_finite(region.lo) || !is_finite(region.hi)) {
        throw InputError(
            fmt::format("the {}'s region is empty or not finite; give a box with finite corners", name));
    }
    const Interval period = positive_range(*settings.period, region, fmt::format("the {}'s period", name));
    const Interval thickness =
        positive_range(*settings.thickness, region, fmt::format("the {}'s thickness", name));
    const dvec3 size = region.size();
    const double longest = std::max(size.x, std::max(size.y, size.z));
    if (longest > max_periods * period.lo) {
        throw InputError(
            fmt::format("the {}'s period goes down to {:.6g} mm, which makes more than {} periods along a "
                        "region of {:.6g} mm; it must be at least {:.4g} mm",
                        name, period.lo, max_periods, longest, longest / max_periods));
    }
    TpmsSettings result = settings;
    result.period = make_clamped_grading(settings.period, period);
    result.thickness = make_clamped_grading(settings.thickness, thickness);
    const double thickest = tight_range(*make_quotient_grading(result.thickness, result.period), region).hi;
    const double limit = greatest_tpms_thickness(settings.kind, settings.network);
    if (!(thickest < limit)) {
        throw InputError(fmt::format(
            "the {}'s thickness goes up to {:.4g} of its period, which {}; it must be less than {:.4g} of "
            "the "
            "period",
            name, thickest, settings.network ? "closes the way between its struts" : "leaves nothing open",
            limit));
    }
    return result;
}

class Tpms : public Field {
  public:
    explicit Tpms(const TpmsSettings& settings)
        : solid_(settings), metric_(solid_.is_constant() ? Metric::bound : Metric::sign) {}

    double value(dvec3 p) const override { return solid_.value(p); }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        solid_.values(points, out);
    }
    Interval range(const Box& box) const override { return solid_.range(box); }
    Metric metric() const override { return metric_; }
    Box bounds() const override { return solid_.region(); }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<TpmsSlice>(*this, solid_, z);
    }

  private:
    TpmsSolid solid_;
    Metric metric_;
};

}  // namespace

double greatest_tpms_thickness(TpmsKind kind, bool network) {
    const double half = network ? TpmsNetwork(kind).greatest_half() : tpms_constants(kind).farthest;
    return half / pi;
}

FieldPtr make_tpms(const TpmsSettings& settings) { return std::make_shared<Tpms>(checked(settings)); }

}  // namespace lamella
