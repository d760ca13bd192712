// Set operations: runs are merged, samples are min and max.
#include "engine/solids/csg.h"

#include "engine/base/error.h"
#include "engine/solids/closed_slice.h"

namespace lamella {
namespace {

using Slices = std::vector<const SliceField*>;

bool meet(const Rect& a, const Rect& b) { return !intersect(a, b).empty(); }

void fill_with_empty_lines(const RowBand& band, RunRows& out) {
    out.clear();
    for (int l = 0; l < band.lines(); ++l) out.end_line();
}

/// Returns the band narrowed to the pixels that hold runs, so that later operands skip the rest.
RowBand narrowed(const RowBand& band, const RunRows& rows) {
    std::int32_t lo = band.hi * run_unit, hi = band.lo * run_unit;
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        const auto line = rows.line(l);
        if (line.empty()) continue;
        lo = std::min(lo, line.front().begin);
        hi = std::max(hi, line.back().end);
    }
    RowBand part = band;
    part.lo = lo >> 8;
    part.hi = std::max(part.lo, (hi + run_unit - 1) >> 8);
    return part;
}

/// Returns the min of both ranges for a union, their max for an intersection.
template <bool is_union>
Interval merge(Interval a, Interval b) {
    if constexpr (is_union) return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
    return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

template <bool is_union, typename Number>
Number pick(Number a, Number b) {
    // NaN counts as outside: it never wins a union and always wins an intersection.
    if constexpr (is_union) return b < a || std::isnan(a) ? b : a;
    return b > a || std::isnan(b) ? b : a;
}

template <bool is_union>
class SetSlice : public SliceField {
  public:
    SetSlice(Slices parts, Rect bounds) : parts_(std::move(parts)), bounds_(bounds) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        if constexpr (is_union) {
            unite_spans(band, scratch, out);
        } else {
            intersect_spans(band, scratch, out);
        }
    }
    Interval range(const Rect& r) const override {
        Interval all = parts_.front()->range(r);
        for (std::size_t i = 1; i < parts_.size(); ++i) all = merge<is_union>(all, parts_[i]->range(r));
        return all;
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        parts_.front()->sample(tile, out);
        std::vector<float> other(out.size());
        for (std::size_t i = 1; i < parts_.size(); ++i) {
            parts_[i]->sample(tile, other);
            for (std::size_t k = 0; k < out.size(); ++k) out[k] = pick<is_union>(out[k], other[k]);
        }
    }
    Rect bounds() const override { return bounds_; }

  private:
    void unite_spans(const RowBand& band, Scratch& scratch, RunRows& out) const {
        const Rect rect = band.rect();
        bool first = true;
        for (const SliceField* part : parts_) {
            if (!meet(part->bounds(), rect)) continue;
            if (first) {
                part->runs(band, scratch, out);
                first = false;
                continue;
            }
            const auto more = scratch.rows(), both = scratch.rows();
            part->runs(band, scratch, *more);
            unite(out, *more, *both);
            std::swap(out, *both);
        }
        if (first) fill_with_empty_lines(band, out);
    }

    void intersect_spans(const RowBand& band, Scratch& scratch, RunRows& out) const {
        if (!meet(bounds_, band.rect())) return fill_with_empty_lines(band, out);
        parts_.front()->runs(band, scratch, out);
        for (std::size_t i = 1; i < parts_.size() && !out.runs().empty(); ++i) {
            const auto more = scratch.rows(), both = scratch.rows();
            parts_[i]->runs(narrowed(band, out), scratch, *more);
            intersect(out, *more, *both);
            std::swap(out, *both);
        }
    }

    Slices parts_;
    Rect bounds_;
};

template <bool is_union>
class SetField : public Field {
  public:
    explicit SetField(std::vector<FieldPtr> solids) : solids_(std::move(solids)) {}

    double value(dvec3 p) const override {
        double v = solids_.front()->value(p);
        for (std::size_t i = 1; i < solids_.size(); ++i) v = pick<is_union>(v, solids_[i]->value(p));
        return v;
    }
    Interval range(const Box& box) const override {
        Interval all = solids_.front()->range(box);
        for (std::size_t i = 1; i < solids_.size(); ++i) all = merge<is_union>(all, solids_[i]->range(box));
        return all;
    }
    Metric metric() const override {
        for (const FieldPtr& solid : solids_) {
            if (solid->metric() == Metric::sign) return Metric::sign;
        }
        return Metric::bound;
    }
    FieldPtr offset(double d) const override {
        // Dilation distributes over a union and erosion over an intersection, not the other way round.
        if (is_union ? d < 0 : d > 0) return nullptr;
        std::vector<FieldPtr> moved;
        for (const FieldPtr& solid : solids_) {
            moved.push_back(solid->offset(d));
            if (!moved.back()) return nullptr;
        }
        return std::make_shared<SetField>(std::move(moved));
    }
    const SliceField& slice(SliceContext& context, double z) const override {
        Slices parts;
        for (const FieldPtr& solid : solids_) parts.push_back(&context.slice(*solid, z));
        Rect bounds = parts.front()->bounds();
        for (const SliceField* part : parts) {
            bounds = is_union ? unite(bounds, part->bounds()) : intersect(bounds, part->bounds());
        }
        return context.make<SetSlice<is_union>>(std::move(parts), bounds);
    }
    Box bounds() const override {
        Box box = solids_.front()->bounds();
        for (const FieldPtr& solid : solids_) {
            box = is_union ? unite(box, solid->bounds()) : intersect(box, solid->bounds());
        }
        return box;
    }

  private:
    std::vector<FieldPtr> solids_;
};

double subtract_values(double from, double taken) {
    return std::isnan(taken) ? from : pick<false>(from, -taken);
}

class DifferenceSlice : public SliceField {
  public:
    DifferenceSlice(const SliceField& from, const SliceField& taken) : from_(from), taken_(taken) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        from_.runs(band, scratch, out);
        if (out.runs().empty() || !meet(taken_.bounds(), band.rect())) return;
        const auto less = scratch.rows(), rest = scratch.rows();
        taken_.runs(narrowed(band, out), scratch, *less);
        subtract(out, *less, *rest);
        std::swap(out, *rest);
    }
    Interval range(const Rect& r) const override {
        const Interval a = from_.range(r), b = taken_.range(r);
        return {std::max(a.lo, -b.hi), std::max(a.hi, -b.lo)};
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        from_.sample(tile, out);
        std::vector<float> other(out.size());
        taken_.sample(tile, other);
        for (std::size_t k = 0; k < out.size(); ++k) {
            out[k] = static_cast<float>(subtract_values(out[k], other[k]));
        }
    }
    Rect bounds() const override { return from_.bounds(); }

  private:
    const SliceField& from_;
    const SliceField& taken_;
};

class Difference : public Field {
  public:
    Difference(FieldPtr from, FieldPtr taken) : from_(std::move(from)), taken_(std::move(taken)) {}

    double value(dvec3 p) const override { return subtract_values(from_->value(p), taken_->value(p)); }
    Interval range(const Box& box) const override {
        const Interval a = from_->range(box), b = taken_->range(box);
        return {std::max(a.lo, -b.hi), std::max(a.hi, -b.lo)};
    }
    Metric metric() const override {
        const bool sign = from_->metric() == Metric::sign || taken_->metric() == Metric::sign;
        return sign ? Metric::sign : Metric::bound;
    }
    FieldPtr offset(double d) const override {
        if (d > 0) return nullptr;
        FieldPtr from = from_->offset(d), taken = taken_->offset(-d);
        return from && taken ? make_difference(std::move(from), std::move(taken)) : nullptr;
    }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<DifferenceSlice>(context.slice(*from_, z), context.slice(*taken_, z));
    }
    Box bounds() const override { return from_->bounds(); }

  private:
    FieldPtr from_, taken_;
};

class Shifted : public Field {
  public:
    Shifted(FieldPtr solid, double d) : solid_(std::move(solid)), d_(d) {}
    double value(dvec3 p) const override { return solid_->value(p) - d_; }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        solid_->values(points, out);
        for (double& value : out) value -= d_;
    }
    void ranges(std::span<const Box> boxes, std::span<Interval> out) const override {
        solid_->ranges(boxes, out);
        for (Interval& values : out) values = {values.lo - d_, values.hi - d_};
    }
    bool takes_many() const override { return solid_->takes_many(); }
    Interval range(const Box& box) const override {
        const Interval r = solid_->range(box);
        return {r.lo - d_, r.hi - d_};
    }
    // Outside a dilated convex corner the shifted value is still the distance; inside an eroded one it is
    // only a bound.
    Metric metric() const override { return d_ >= 0 ? Metric::exact : Metric::bound; }
    Box bounds() const override { return grown(solid_->bounds(), std::max(d_, 0.0)); }

  private:
    FieldPtr solid_;
    double d_;
};

void require_solids(const std::vector<FieldPtr>& solids, const char* what) {
    if (solids.empty()) throw InputError(std::string(what) + " needs at least one solid");
    for (const FieldPtr& solid : solids) {
        if (!solid) throw InputError(std::string(what) + " was given a missing solid");
    }
}

}  // namespace

FieldPtr make_union(std::vector<FieldPtr> solids) {
    require_solids(solids, "a union");
    return std::make_shared<SetField<true>>(std::move(solids));
}

FieldPtr make_intersection(std::vector<FieldPtr> solids) {
    require_solids(solids, "an intersection");
    return std::make_shared<SetField<false>>(std::move(solids));
}

FieldPtr make_difference(FieldPtr from, FieldPtr taken) {
    require_solids({from, taken}, "a difference");
    return std::make_shared<Difference>(std::move(from), std::move(taken));
}

FieldPtr make_offset(FieldPtr solid, double d) {
    require_solids({solid}, "an offset");
    if (!std::isfinite(d)) throw InputError("an offset needs a finite distance");
    if (d == 0) return solid;
    if (FieldPtr closed = solid->offset(d)) return closed;
    if (solid->metric() != Metric::exact) {
        throw InputError("this solid has no exact 3D offset: its values are not distances");
    }
    return std::make_shared<Shifted>(std::move(solid), d);
}

}  // namespace lamella
