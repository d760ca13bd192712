// Primitives: exact distances, closed-form offsets, closed-form intersections with a line.
#include "engine/solids/primitives.h"

#include <optional>
#include <utility>

#include "engine/base/box_image.h"
#include "engine/base/error.h"
#include "engine/solids/closed_slice.h"
#include "engine/solids/torus.h"

namespace lamella {
namespace {

void require(bool holds, const char* message) {
    if (!holds) throw InputError(message);
}

bool positive(double v) { return v > 0 && std::isfinite(v); }

class Empty : public Field {
  public:
    double value(dvec3 /*p*/) const override { return infinity; }
    Interval range(const Box& /*box*/) const override { return {infinity, infinity}; }
    Metric metric() const override { return Metric::exact; }
    FieldPtr offset(double /*d*/) const override { return make_empty(); }
    Box bounds() const override { return {}; }
};

/// Shape with a value that changes by at most 1 per mm and a closed-form intersection with a line.
template <typename Shape>
class ClosedShape : public Field {
  public:
    Interval range(const Box& box) const override { return lipschitz_range(*this, box); }
    Metric metric() const override { return Metric::exact; }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<ClosedSlice<Shape>>(static_cast<const Shape&>(*this), z);
    }
};

class Sphere : public ClosedShape<Sphere> {
  public:
    Sphere(dvec3 center, double radius) : center_(center), radius_(radius) {}
    double value(dvec3 p) const override { return length(p - center_) - radius_; }
    FieldPtr offset(double d) const override {
        return radius_ + d > 0 ? make_sphere(center_, radius_ + d) : make_empty();
    }
    Box bounds() const override { return {center_ - radius_, center_ + radius_}; }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const double along_center = axis == Axis::x ? center_.x : center_.y;
        const double v = across - (axis == Axis::x ? center_.y : center_.x), w = z - center_.z;
        const double h = radius_ * radius_ - v * v - w * w;
        if (h > 0) out.push_back({along_center - std::sqrt(h), along_center + std::sqrt(h)});
    }

  private:
    dvec3 center_;
    double radius_;
};

/// All points within `rounding_` of a core box.
class RoundedBox : public ClosedShape<RoundedBox> {
  public:
    RoundedBox(const Box& core, double rounding) : core_(core), rounding_(rounding) {}
    double value(dvec3 p) const override {
        const dvec3 q = glm::max(core_.lo - p, p - core_.hi);
        const double inside = std::min(std::max(q.x, std::max(q.y, q.z)), 0.0);
        return length(glm::max(q, dvec3(0.0))) + inside - rounding_;
    }
    FieldPtr offset(double d) const override {
        const double rounding = std::max(rounding_ + d, 0.0);
        const Box core = grown(core_, rounding_ + d - rounding);
        if (core.empty()) return make_empty();
        return std::make_shared<RoundedBox>(core, rounding);
    }
    Box bounds() const override { return grown(core_, rounding_); }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const int along_axis = axis == Axis::x ? 0 : 1, across_axis = 1 - along_axis;
        if (rounding_ == 0) {
            // A box owns its lower faces only, so that boxes that share a face do not overlap.
            const bool in = core_.lo[across_axis] <= across && across < core_.hi[across_axis] &&
                            core_.lo.z <= z && z < core_.hi.z;
            if (in) out.push_back({core_.lo[along_axis], core_.hi[along_axis]});
            return;
        }
        const double v =
            std::max(std::max(core_.lo[across_axis] - across, across - core_.hi[across_axis]), 0.0);
        const double w = std::max(std::max(core_.lo.z - z, z - core_.hi.z), 0.0);
        const double h = rounding_ * rounding_ - v * v - w * w;
        if (h > 0) out.push_back({core_.lo[along_axis] - std::sqrt(h), core_.hi[along_axis] + std::sqrt(h)});
    }

  private:
    Box core_;
    double rounding_;
};

class Cylinder : public ClosedShape<Cylinder> {
  public:
    Cylinder(dvec3 a, dvec3 b, double radius)
        : a_(a), length_(length(b - a)), axis_((b - a) / length_), radius_(radius) {}
    double value(dvec3 p) const override {
        const dvec3 d = p - a_;
        const double x = glm::dot(d, axis_);
        const double radial = length(d - axis_ * x) - radius_;
        const double axial = std::max(-x, x - length_);
        const double outside_r = std::max(radial, 0.0), outside_a = std::max(axial, 0.0);
        return std::min(std::max(radial, axial), 0.0) +
               std::sqrt(outside_r * outside_r + outside_a * outside_a);
    }
    FieldPtr offset(double d) const override {
        if (d > 0) return nullptr;
        if (radius_ + d <= 0 || length_ + 2 * d <= 0) return make_empty();
        return make_cylinder(a_ - axis_ * d, a_ + axis_ * (length_ + d), radius_ + d);
    }
    Box bounds() const override {
        const dvec3 b = a_ + axis_ * length_;
        const dvec3 disc = radius_ * glm::sqrt(glm::max(dvec3(1.0) - axis_ * axis_, dvec3(0.0)));
        return {glm::min(a_, b) - disc, glm::max(a_, b) + disc};
    }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const dvec3 p = dvec3(on_plane(axis, 0, across), z) - a_;
        const dvec3 direction = axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        const double u = glm::dot(direction, axis_), q = glm::dot(p, axis_);
        const dvec3 e = direction - axis_ * u, off = p - axis_ * q;
        Interval solid{-infinity, infinity};
        if (u != 0) {
            const double t0 = -q / u, t1 = (length_ - q) / u;
            solid = {std::min(t0, t1), std::max(t0, t1)};
        } else if (q < 0 || q >= length_) {
            return;
        }
        const double a = glm::dot(e, e), b = glm::dot(e, off), c = glm::dot(off, off) - radius_ * radius_;
        if (a > 0) {
            const double disc = b * b - a * c;
            if (disc <= 0) return;
            const double root = std::sqrt(disc);
            solid = {std::max(solid.lo, (-b - root) / a), std::min(solid.hi, (-b + root) / a)};
        } else if (c >= 0) {
            return;
        }
        if (solid.lo < solid.hi) out.push_back(solid);
    }

  private:
    dvec3 a_;
    double length_;
    dvec3 axis_;
    double radius_;
};

class RoundConeField : public ClosedShape<RoundConeField> {
  public:
    explicit RoundConeField(const Beam& beam) : beam_(beam) {}
    double value(dvec3 p) const override { return signed_distance(beam_, p); }
    FieldPtr offset(double d) const override {
        if (beam_.ra + d <= 0 || beam_.rb + d <= 0) return nullptr;
        return make_round_cone({beam_.a, beam_.ra + d, beam_.b, beam_.rb + d});
    }
    Box bounds() const override { return lamella::bounds(beam_); }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const dvec3 direction = axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        if (const auto solid = lamella::cut(beam_, dvec3(on_plane(axis, 0, across), z), direction))
            out.push_back(*solid);
    }

  private:
    Beam beam_;
};

class UprightTorus : public ClosedShape<UprightTorus> {
  public:
    UprightTorus(dvec3 center, double major, double minor) : center_(center), major_(major), minor_(minor) {}
    double value(dvec3 p) const override {
        const dvec3 d = p - center_;
        const double ring = std::sqrt(d.x * d.x + d.y * d.y) - major_;
        return std::sqrt(ring * ring + d.z * d.z) - minor_;
    }
    FieldPtr offset(double d) const override {
        if (minor_ + d <= 0) return make_empty();
        return minor_ + d < major_ ? make_torus(center_, major_, minor_ + d) : nullptr;
    }
    Box bounds() const override {
        const dvec3 half(major_ + minor_, major_ + minor_, minor_);
        return {center_ - half, center_ + half};
    }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const double w = z - center_.z, h = minor_ * minor_ - w * w;
        if (!(h > 0)) return;
        const double along_center = axis == Axis::x ? center_.x : center_.y;
        const double v = across - (axis == Axis::x ? center_.y : center_.x);
        const double outer = major_ + std::sqrt(h), inner = major_ - std::sqrt(h);
        const double ho = outer * outer - v * v, hi = inner * inner - v * v;
        if (!(ho > 0)) return;
        const double o = std::sqrt(ho);
        if (hi > 0) {
            const double i = std::sqrt(hi);
            out.push_back({along_center - o, along_center - i});
            out.push_back({along_center + i, along_center + o});
        } else {
            out.push_back({along_center - o, along_center + o});
        }
    }

  private:
    dvec3 center_;
    double major_, minor_;
};

/// A shape of its own space that is rotated or mirrored, then moved. Shape has value(), offset(), bounds()
/// and cut() there.
template <typename Shape>
class Turned : public ClosedShape<Turned<Shape>> {
  public:
    Turned(Shape shape, const glm::dmat3& axes, dvec3 at)
        : shape_(std::move(shape)), axes_(axes), back_(glm::transpose(axes)), at_(at) {}
    double value(dvec3 p) const override { return shape_.value(back_ * (p - at_)); }
    FieldPtr offset(double d) const override {
        const std::optional<Shape> grown = shape_.offset(d);
        return grown ? std::make_shared<Turned>(*grown, axes_, at_) : nullptr;
    }
    Box bounds() const override { return shape_.bounds(axes_, at_); }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const dvec3 direction = axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        shape_.cut(back_ * (dvec3(on_plane(axis, 0, across), z) - at_), back_ * direction, out);
    }

  private:
    Shape shape_;
    glm::dmat3 axes_, back_;
    dvec3 at_;
};

/// A box of its own space.
class LineCutBox {
  public:
    explicit LineCutBox(const Box& box) : box_(box) {}
    double value(dvec3 p) const {
        const dvec3 q = glm::max(box_.lo - p, p - box_.hi);
        return length(glm::max(q, dvec3(0.0))) + std::min(std::max(q.x, std::max(q.y, q.z)), 0.0);
    }
    /// Only inward: outward, edges become round.
    std::optional<LineCutBox> offset(double d) const {
        const Box smaller = grown(box_, d);
        if (d > 0 || smaller.empty()) return std::nullopt;
        return LineCutBox(smaller);
    }
    Box bounds(const glm::dmat3& axes, dvec3 at) const { return image_of(box_, axes, at); }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& out) const {
        Interval solid{-infinity, infinity};
        for (int i = 0; i < 3; ++i) {
            if (direction[i] == 0) {
                // As an upright box, it owns its lower faces only.
                if (!(box_.lo[i] <= p[i] && p[i] < box_.hi[i])) return;
                continue;
            }
            const double a = (box_.lo[i] - p[i]) / direction[i], b = (box_.hi[i] - p[i]) / direction[i];
            solid = {std::max(solid.lo, std::min(a, b)), std::min(solid.hi, std::max(a, b))};
        }
        if (solid.lo < solid.hi) out.push_back(solid);
    }

  private:
    Box box_;
};

class LineCutTorus {
  public:
    explicit LineCutTorus(const Torus& torus) : torus_(torus) {}
    double value(dvec3 p) const { return signed_distance(torus_, p); }
    std::optional<LineCutTorus> offset(double d) const {
        const Torus other{torus_.large, torus_.small + d};
        if (!(other.small > 0) || !(other.small < other.large)) return std::nullopt;
        return LineCutTorus(other);
    }
    Box bounds(const glm::dmat3& axes, dvec3 at) const {
        const dvec3 n = axes[2];
        const dvec3 half =
            torus_.large * glm::sqrt(glm::max(dvec3(1.0) - n * n, dvec3(0.0))) + dvec3(torus_.small);
        return {at - half, at + half};
    }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& out) const {
        lamella::cut(torus_, p, direction, out);
    }

  private:
    Torus torus_;
};

class HalfSpace : public ClosedShape<HalfSpace> {
  public:
    HalfSpace(dvec3 normal, double offset) : normal_(normal), offset_(offset) {}
    double value(dvec3 p) const override { return glm::dot(p, normal_) - offset_; }
    FieldPtr offset(double d) const override { return std::make_shared<HalfSpace>(normal_, offset_ + d); }
    Box bounds() const override {
        Box box{dvec3(-infinity), dvec3(infinity)};
        for (int i = 0; i < 3; ++i) {
            if (normal_[i] == 1) box.hi[i] = offset_;
            if (normal_[i] == -1) box.lo[i] = -offset_;
        }
        return box;
    }
    void cut(Axis axis, double across, double z, std::vector<Interval>& out) const {
        const double n = axis == Axis::x ? normal_.x : normal_.y;
        const double room = offset_ - glm::dot(normal_, dvec3(on_plane(axis, 0, across), z));
        if (n > 0) {
            out.push_back({-infinity, room / n});
        } else if (n < 0) {
            out.push_back({room / n, infinity});
        } else if (room > 0) {
            out.push_back({-infinity, infinity});
        }
    }

  private:
    dvec3 normal_;
    double offset_;
};

}  // namespace

FieldPtr make_empty() { return std::make_shared<Empty>(); }

FieldPtr make_sphere(dvec3 center, double radius) {
    require(is_finite(center) && positive(radius), "a sphere needs a positive, finite radius");
    return std::make_shared<Sphere>(center, radius);
}

FieldPtr make_box(const Box& box, double rounding) {
    const dvec3 size = box.size();
    require(is_finite(size) && size.x > 0 && size.y > 0 && size.z > 0,
            "a box needs three positive, finite sides");
    require(rounding >= 0 && 2 * rounding <= std::min(size.x, std::min(size.y, size.z)),
            "a box's rounding lies between 0 and half its shortest side");
    return std::make_shared<RoundedBox>(grown(box, -rounding), rounding);
}

FieldPtr make_cylinder(dvec3 a, dvec3 b, double radius) {
    require(is_finite(a) && is_finite(b) && positive(radius) && positive(length(b - a)),
            "a cylinder needs a positive radius and two different ends");
    return std::make_shared<Cylinder>(a, b, radius);
}

FieldPtr make_round_cone(const Beam& beam) {
    require(is_finite(beam.a) && is_finite(beam.b) && positive(beam.ra) && positive(beam.rb),
            "a round cone needs two positive, finite radii");
    return std::make_shared<RoundConeField>(beam);
}

FieldPtr make_torus(dvec3 center, double major_radius, double minor_radius) {
    require(
        is_finite(center) && positive(major_radius) && positive(minor_radius) && minor_radius < major_radius,
        "a torus needs a positive tube radius that is smaller than the ring's");
    return std::make_shared<UprightTorus>(center, major_radius, minor_radius);
}

FieldPtr make_turned_box(const Box& box, const glm::dmat3& axes, dvec3 at) {
    const dvec3 size = box.size();
    require(is_finite(size) && size.x > 0 && size.y > 0 && size.z > 0,
            "a box needs three positive, finite sides");
    return std::make_shared<Turned<LineCutBox>>(LineCutBox(box), axes, at);
}

FieldPtr make_turned_torus(double major_radius, double minor_radius, const glm::dmat3& axes, dvec3 at) {
    require(positive(major_radius) && positive(minor_radius) && minor_radius < major_radius,
            "a torus needs a positive tube radius that is smaller than the ring's");
    return std::make_shared<Turned<LineCutTorus>>(LineCutTorus({major_radius, minor_radius}), axes, at);
}

FieldPtr make_half_space(dvec3 normal, double offset) {
    const double l = length(normal);
    require(positive(l) && std::isfinite(offset), "a half-space needs a normal that is not zero");
    return std::make_shared<HalfSpace>(normal / l, offset);
}

}  // namespace lamella
