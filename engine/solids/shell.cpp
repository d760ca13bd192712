// Shells by the body's own closed form, and filled bodies that evaluate the body once per point.
#include "engine/solids/shell.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace lamella {
namespace {

/// Delegates all but the values at points to the CSG solid. A subclass evaluates the body once per value, and
/// its distance only up to the limit that matters: deep inside, the filling alone decides.
class LazySolid : public Field {
  public:
    LazySolid(FieldPtr filling, FieldPtr solid) : filling_(std::move(filling)), solid_(std::move(solid)) {}
    double value(dvec3 p) const override { return value_of(p, filling_->value(p)); }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        filling_->values(points, out);
        for (std::size_t i = 0; i < points.size(); ++i) out[i] = value_of(points[i], out[i]);
    }
    Interval range(const Box& box) const override { return solid_->range(box); }
    Metric metric() const override { return solid_->metric(); }
    FieldPtr offset(double d) const override { return solid_->offset(d); }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.slice(*solid_, z);
    }
    Box bounds() const override { return solid_->bounds(); }

  protected:
    double slow_value(dvec3 p) const { return solid_->value(p); }

  private:
    /// Returns the value at a point where that of the filling is `f`.
    virtual double value_of(dvec3 p, double f) const = 0;

    FieldPtr filling_, solid_;
};

class FilledBody : public LazySolid {
  public:
    FilledBody(FieldPtr body, FieldPtr filling, double thickness, FieldPtr solid)
        : LazySolid(std::move(filling), std::move(solid)), body_(std::move(body)), thickness_(thickness) {}

  private:
    double value_of(dvec3 p, double f) const override {
        // Inside, at depth d: max(-d, min(f, d - thickness)), which is f once d reaches both -f and f +
        // thickness.
        const double enough = std::max(-f, thickness_ > 0 ? f + thickness_ : 0.0);
        double b = body_->value_within(p, enough > 0 && std::isfinite(enough) ? enough : infinity);
        if (b > 0) {
            if (b >= enough) b = body_->value(p);
            return thickness_ > 0 ? b : std::max(b, f);
        }
        if (-b >= enough) return f;
        return std::max(b, thickness_ > 0 ? std::min(f, -b - thickness_) : f);
    }

    FieldPtr body_;
    double thickness_;
};

/// A filled body under a skin of graded thickness, which is evaluated only where the skin can reach.
class FilledGradedSkin : public LazySolid {
  public:
    FilledGradedSkin(FieldPtr body, const FieldPtr& filling, FieldPtr shell, double thickest)
        : LazySolid(filling, make_intersection({body, make_union({filling, shell})})),
          body_(std::move(body)),
          shell_(std::move(shell)),
          thickest_(thickest) {}

  private:
    double value_of(dvec3 p, double f) const override {
        // At depth d the shell's value is at least d - thickest.
        const double enough = std::max(-f, f + thickest_);
        const double b = body_->value_within(p, enough > 0 && std::isfinite(enough) ? enough : infinity);
        if (-b >= enough) return f;
        if (b >= enough) return slow_value(p);
        return std::max(b, std::min(f, shell_->value(p)));
    }

    FieldPtr body_, shell_;
    double thickest_;
};

/// Points inside a body with exact distances, no deeper than the thickness at the point.
class GradedShell : public Field {
  public:
    GradedShell(FieldPtr body, GradingPtr thickness)
        : body_(std::move(body)), thickness_(std::move(thickness)) {}
    double value(dvec3 p) const override { return -body_->value(p) - thickness_->at(p); }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        std::vector<double> thickness(points.size());
        thickness_->numbers(points, thickness);
        body_->values(points, out);
        for (std::size_t i = 0; i < points.size(); ++i) out[i] = -out[i] - thickness[i];
    }
    bool takes_many() const override { return true; }
    void ranges(std::span<const Box> boxes, std::span<Interval> out) const override {
        body_->ranges(boxes, out);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Interval thickness = thickness_->range(boxes[i]);
            out[i] = {-out[i].hi - thickness.hi, -out[i].lo - thickness.lo};
        }
    }
    Interval range(const Box& box) const override {
        Interval values;
        ranges({&box, 1}, {&values, 1});
        return values;
    }
    Metric metric() const override { return Metric::sign; }
    double deviation(const Box& box) const override {
        return body_->deviation(box) + thickness_->range(box).width() / 2;
    }
    Box bounds() const override { return body_->bounds(); }

  private:
    FieldPtr body_;
    GradingPtr thickness_;
};

/// Points outside a body with exact distances, no farther away than the thickness at the point.
class GradedOuterShell : public Field {
  public:
    GradedOuterShell(FieldPtr body, GradingPtr thickness, double greatest)
        : body_(std::move(body)), thickness_(std::move(thickness)), greatest_(greatest) {}
    double value(dvec3 p) const override { return body_->value(p) - thickness_->at(p); }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        std::vector<double> thickness(points.size());
        thickness_->numbers(points, thickness);
        body_->values(points, out);
        for (std::size_t i = 0; i < points.size(); ++i) out[i] -= thickness[i];
    }
    bool takes_many() const override { return true; }
    void ranges(std::span<const Box> boxes, std::span<Interval> out) const override {
        body_->ranges(boxes, out);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Interval thickness = thickness_->range(boxes[i]);
            out[i] = {out[i].lo - thickness.hi, out[i].hi - thickness.lo};
        }
    }
    Interval range(const Box& box) const override {
        Interval values;
        ranges({&box, 1}, {&values, 1});
        return values;
    }
    Metric metric() const override { return Metric::sign; }
    double deviation(const Box& box) const override {
        return body_->deviation(box) + thickness_->range(box).width() / 2;
    }
    Box bounds() const override { return grown(body_->bounds(), greatest_); }

  private:
    FieldPtr body_;
    GradingPtr thickness_;
    double greatest_;
};

/// Returns the range of the thickness within reach of a body. The shell reaches as far from the body's box as
/// the greatest thickness; this bounds the places where the thickness is read, and so the greatest thickness
/// again.
Interval thickness_about(const Box& body, const Grading& thickness, Interval limits) {
    constexpr int rounds = 8;
    Interval asked = limits;
    for (int round = 0; round < rounds; ++round) asked = tight_range(thickness, grown(body, asked.hi));
    return asked;
}

/// Half of a thickness.
class Half : public Grading {
  public:
    explicit Half(GradingPtr whole) : whole_(std::move(whole)) {}
    double at(dvec3 p) const override { return whole_->at(p) / 2; }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*whole_, points, out, [](double whole) { return whole / 2; });
    }
    Interval range(const Box& box) const override {
        const Interval r = whole_->range(box);
        return {r.lo / 2, r.hi / 2};
    }

  private:
    GradingPtr whole_;
};

/// Returns the thickness clamped to the limits. Throws InputError when an argument is null, or the limits
/// allow no skin.
GradingPtr thickness_within(const FieldPtr& body, const GradingPtr& thickness, Interval limits) {
    if (!body || !thickness) throw InputError("a graded skin needs a body and a thickness");
    if (!(0 <= limits.lo && limits.lo <= limits.hi && 0 < limits.hi && std::isfinite(limits.hi))) {
        throw InputError(fmt::format(
            "the thickness of a graded skin is limited to {} .. {} mm; the limits must be in order "
            "and finite, the lower one at least 0, the upper one above 0",
            limits.lo, limits.hi));
    }
    return make_clamped_grading(thickness, limits);
}

const ShellMaker* shell_maker(const FieldPtr& body) { return dynamic_cast<const ShellMaker*>(body.get()); }

[[noreturn]] void refuse_skin() {
    throw InputError("this shape has no exact 3D offset, so it cannot be given a skin of a stated thickness");
}

}  // namespace

FieldPtr make_shell(const FieldPtr& body, double thickness) {
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError("a skin needs a positive, finite thickness");
    if (const auto* maker = shell_maker(body)) return maker->shell(thickness);
    if (FieldPtr core = body->offset(-thickness)) return make_difference(body, std::move(core));
    if (body->metric() != Metric::exact) refuse_skin();
    return make_difference(body, make_offset(body, -thickness));
}

FieldPtr make_shell(const FieldPtr& body, const GradingPtr& thickness, Interval limits) {
    const GradingPtr clamped = thickness_within(body, thickness, limits);
    const Interval asked = clamped->range(body->bounds());
    if (asked.hi == 0) return make_empty();
    if (asked.width() == 0) return make_shell(body, asked.hi);
    if (const auto* maker = shell_maker(body)) return maker->graded_shell(*clamped);
    if (body->metric() != Metric::exact) refuse_skin();
    return std::make_shared<GradedShell>(body, clamped);
}

FieldPtr make_outer_shell(const FieldPtr& body, double thickness) {
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError("a skin needs a positive, finite thickness");
    if (FieldPtr grown = body->offset(thickness)) return grown;
    if (body->metric() != Metric::exact) refuse_skin();
    return make_offset(body, thickness);
}

FieldPtr make_outer_shell(const FieldPtr& body, const GradingPtr& thickness, Interval limits) {
    const GradingPtr clamped = thickness_within(body, thickness, limits);
    if (const auto constant = clamped->constant())
        return *constant > 0 ? make_outer_shell(body, *constant) : make_empty();
    if (const auto* maker = shell_maker(body)) return maker->graded_outer_shell(*clamped);
    if (body->metric() != Metric::exact) refuse_skin();
    const Interval asked = thickness_about(body->bounds(), *clamped, limits);
    if (asked.hi == 0) return make_empty();
    return std::make_shared<GradedOuterShell>(body, clamped, asked.hi);
}

FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, double thickness, SkinSide side) {
    const bool skinned = thickness > 0;
    if (!body || (!filling && !skinned))
        throw InputError("a filled body needs a body, and a filling or a skin");
    if (skinned && side != SkinSide::inside) {
        const double inner = side == SkinSide::centred ? thickness / 2 : 0;
        FieldPtr skin = make_difference(make_outer_shell(body, thickness - inner), body);
        if (!filling && inner == 0) return skin;
        return make_union({make_filled_body(std::move(body), std::move(filling), inner), std::move(skin)});
    }
    FieldPtr shell = skinned ? make_shell(body, thickness) : nullptr;
    if (!filling) return make_intersection({std::move(body), std::move(shell)});
    FieldPtr inside = skinned ? make_union({filling, std::move(shell)}) : filling;
    FieldPtr solid = make_intersection({body, std::move(inside)});
    return std::make_shared<FilledBody>(std::move(body), std::move(filling), thickness, std::move(solid));
}

FieldPtr make_filled_body(FieldPtr body, FieldPtr filling, const GradingPtr& thickness, Interval limits,
                          SkinSide side) {
    if (side == SkinSide::outside) {
        FieldPtr skin = make_difference(make_outer_shell(body, thickness, limits), body);
        if (!filling) return skin;
        return make_union({make_intersection({std::move(body), std::move(filling)}), std::move(skin)});
    }
    if (side == SkinSide::centred) {
        const auto half = std::make_shared<Half>(thickness_within(body, thickness, limits));
        limits = {limits.lo / 2, limits.hi / 2};
        FieldPtr skin = make_difference(make_outer_shell(body, half, limits), body);
        return make_union(
            {make_filled_body(std::move(body), std::move(filling), half, limits), std::move(skin)});
    }
    const Interval asked = thickness_within(body, thickness, limits)->range(body->bounds());
    if (asked.width() == 0) return make_filled_body(std::move(body), std::move(filling), asked.hi);
    FieldPtr shell = make_shell(body, thickness, limits);
    if (!filling) return make_intersection({std::move(body), std::move(shell)});
    return std::make_shared<FilledGradedSkin>(std::move(body), filling, std::move(shell), asked.hi);
}

}  // namespace lamella
