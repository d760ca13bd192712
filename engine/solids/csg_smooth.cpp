// Set operations with rounded seams: the polynomial smooth minimum (Quilez, "smooth minimum", quadratic
// form), sampled along the seam only.
#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"
#include "engine/solids/csg.h"

namespace lamella {
namespace {

/// Returns the smaller number, less up to a quarter of the radius if the two differ by less than the radius.
/// NaN counts as the greater number.
double smooth_min(double a, double b, double radius) {
    const double lowest = b < a || std::isnan(a) ? b : a;
    const double h = std::max(radius - std::abs(a - b), 0.0) / radius;
    return std::isnan(h) ? lowest : lowest - h * h * radius * 0.25;
}

/// Returns a range that encloses smooth_min over two ranges; smooth_min is monotonic in both arguments.
Interval smooth_min(Interval a, Interval b, double radius) {
    if (b.lo - a.hi >= radius) return a;
    if (a.lo - b.hi >= radius) return b;
    const double lo = smooth_min(a.lo, b.lo, radius), hi = smooth_min(a.hi, b.hi, radius);
    const auto rounding = [&](double v) { return std::isfinite(v) ? 1e-15 * (std::abs(v) + radius) : 0; };
    return {lo - rounding(lo), hi + rounding(hi)};
}

/// A convex mean of two gradients of length at most 1 is not longer than 1.
Metric metric_of(const Field& a, const Field& b) {
    return a.metric() == Metric::sign || b.metric() == Metric::sign ? Metric::sign : Metric::bound;
}

/// The part that a smooth union has, or a smooth difference lacks, in addition to its operands' own runs:
/// where the smooth minimum of a's value and the tool's is negative, at most `radius` outside the tool, and
/// the tool itself. Outside both solids it is negative only where neither value exceeds the radius, so `a` is
/// not evaluated elsewhere: farther outside, the value is the distance to the zone where it may be negative;
/// inside the tool, it is the tool's. The jumps at the zone's borders lie inside a or the tool, or do not
/// invalidate a proof. Ranges leave out what lies in the operands' own runs.
class Seam : public Field {
  public:
    Seam(const Field& a, bool inverted, const Field& tool, double radius)
        : a_(a), inverted_(inverted), tool_(tool), radius_(radius) {}

    double value(dvec3 p) const override {
        const double tool = tool_.value(p);
        if (!(tool < radius_)) return tool - radius_;
        if (tool < 0) return tool;
        return blended(a_.value(p), tool);
    }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        tool_.values(points, out);
        std::vector<dvec3> near;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!(out[i] < radius_)) {
                out[i] -= radius_;
            } else if (!(out[i] < 0)) {
                near.push_back(points[i]);
                places.push_back(i);
            }
        }
        std::vector<double> a(near.size());
        a_.values(near, a);
        for (std::size_t k = 0; k < near.size(); ++k) out[places[k]] = blended(a[k], out[places[k]]);
    }
    bool takes_many() const override { return a_.takes_many() || tool_.takes_many(); }
    Interval range(const Box& box) const override {
        const Interval nothing{radius_, radius_};
        const Interval tool = tool_.range(box);
        if (tool.hi < 0) return nothing;
        if (tool.lo >= radius_) return {tool.lo - radius_, tool.hi - radius_};
        const Interval of_a = a_.range(box), a = inverted_ ? Interval{-of_a.hi, -of_a.lo} : of_a;
        if (a.hi < 0 || a.lo >= radius_) return nothing;
        Interval all = smooth_min(a, {std::max(tool.lo, 0.0), std::min(tool.hi, radius_)}, radius_);
        if (tool.hi >= radius_) all = {std::min(all.lo, 0.0), std::max(all.hi, tool.hi - radius_)};
        return all;
    }
    Metric metric() const override { return metric_of(a_, tool_); }
    /// Everywhere unless the tool's metric is exact: a mere bound may stay below the radius at any distance.
    Box bounds() const override {
        const Box everywhere{dvec3(-infinity), dvec3(infinity)};
        return tool_.metric() == Metric::exact ? grown(tool_.bounds(), radius_) : everywhere;
    }

  private:
    double blended(double a, double tool) const { return smooth_min(inverted_ ? -a : a, tool, radius_); }

    const Field& a_;
    bool inverted_;
    const Field& tool_;
    double radius_;
};

bool meet(const Rect& a, const RowBand& band) { return !intersect(a, band.rect()).empty(); }

/// Runs of the operands, joined or subtracted, and those of the seam.
template <bool is_union>
class SmoothSlice : public SampledSlice {
  public:
    SmoothSlice(const Field& field, const SliceField& a, const SliceField& tool, const SliceField& seam,
                double z)
        : SampledSlice(field, z), a_(a), tool_(tool), seam_(seam) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        a_.runs(band, scratch, out);
        for (const SliceField* more : {&tool_, &seam_}) {
            if (!meet(more->bounds(), band) || (!is_union && out.runs().empty())) continue;
            const auto rows = scratch.rows(), result = scratch.rows();
            more->runs(band, scratch, *rows);
            is_union ? unite(out, *rows, *result) : subtract(out, *rows, *result);
            std::swap(out, *result);
        }
    }

  private:
    const SliceField& a_;
    const SliceField& tool_;
    const SliceField& seam_;
};

/// Smooth union or difference with the tool.
template <bool is_union>
class SmoothSolid : public Field {
  public:
    SmoothSolid(FieldPtr a, FieldPtr tool, double radius)
        : a_(std::move(a)),
          tool_(std::move(tool)),
          radius_(radius),
          seam_(std::make_shared<Seam>(*a_, !is_union, *tool_, radius)) {}

    double value(dvec3 p) const override { return blended(a_->value(p), tool_->value(p)); }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        std::vector<double> tool(points.size());
        a_->values(points, out);
        tool_->values(points, tool);
        for (std::size_t i = 0; i < points.size(); ++i) out[i] = blended(out[i], tool[i]);
    }
    Interval range(const Box& box) const override {
        const Interval a = a_->range(box), tool = tool_->range(box);
        if constexpr (is_union) return smooth_min(a, tool, radius_);
        const Interval less = smooth_min(Interval{-a.hi, -a.lo}, tool, radius_);
        return {-less.hi, a.hi == infinity ? infinity : -less.lo};
    }
    Metric metric() const override { return metric_of(*a_, *tool_); }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<SmoothSlice<is_union>>(*this, context.slice(*a_, z), context.slice(*tool_, z),
                                                   context.slice(*seam_, z), z);
    }
    Box bounds() const override {
        return is_union ? grown(unite(a_->bounds(), tool_->bounds()), radius_ * 0.25) : a_->bounds();
    }

  private:
    double blended(double a, double tool) const {
        if constexpr (is_union) return smooth_min(a, tool, radius_);
        return std::isnan(a) ? a : -smooth_min(-a, tool, radius_);
    }

    FieldPtr a_, tool_;
    double radius_;
    FieldPtr seam_;
};

template <bool is_union>
FieldPtr make_smooth(FieldPtr a, FieldPtr tool, double radius) {
    const std::string what = is_union ? "a smooth union" : "a smooth difference";
    if (!a || !tool) throw InputError(what + " was given a missing solid");
    if (!(radius > 0) || !std::isfinite(radius)) throw InputError(what + " needs a positive, finite radius");
    return std::make_shared<SmoothSolid<is_union>>(std::move(a), std::move(tool), radius);
}

}  // namespace

FieldPtr make_smooth_union(FieldPtr a, FieldPtr b, double radius) {
    return make_smooth<true>(std::move(a), std::move(b), radius);
}

FieldPtr make_smooth_difference(FieldPtr from, FieldPtr taken, double radius) {
    return make_smooth<false>(std::move(from), std::move(taken), radius);
}

}  // namespace lamella
