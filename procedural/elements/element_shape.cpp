// Cuts in closed form for sticks, rings and outlines, by steps of the distance for fields.
#include "procedural/elements/element_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/root_between.h"
#include "engine/solids/torus.h"

namespace lamella {

namespace {

/// Returns the interval of t in which a line lies inside a box; empty if it misses it.
Interval cut_box(const Box& box, dvec3 p, dvec3 direction) {
    Interval inside{-infinity, infinity};
    for (int axis = 0; axis < 3; ++axis) {
        const double step = direction[axis];
        if (step == 0) {
            if (p[axis] < box.lo[axis] || p[axis] > box.hi[axis]) return {};
            continue;
        }
        const double a = (box.lo[axis] - p[axis]) / step, b = (box.hi[axis] - p[axis]) / step;
        inside = {std::max(inside.lo, std::min(a, b)), std::min(inside.hi, std::max(a, b))};
    }
    return inside;
}

class Stick : public ElementShape {
  public:
    Stick(double length, double width)
        : beam_{{0.5 * (width - length), 0, 0}, 0.5 * width, {0.5 * (length - width), 0, 0}, 0.5 * width} {}
    double distance(dvec3 p) const override { return signed_distance(beam_, p); }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override {
        const double speed = length(direction);
        if (const auto found = lamella::cut(beam_, p, direction / speed))
            inside.push_back({found->lo / speed, found->hi / speed});
    }
    Box bounds() const override { return lamella::bounds(beam_); }
    std::optional<Beam> beam() const override { return beam_; }

  private:
    Beam beam_;
};

class Outline : public ElementShape {
  public:
    Outline(std::vector<std::vector<dvec2>> polygons, double thickness)
        : polygons_(std::move(polygons)), half_(0.5 * thickness) {
        for (const auto& polygon : polygons_) {
            for (const dvec2 corner : polygon)
                bounds_ = {glm::min(bounds_.lo, dvec3(corner, -half_)),
                           glm::max(bounds_.hi, dvec3(corner, half_))};
        }
    }
    double distance(dvec3 p) const override {
        const double in_plane = plane_distance(dvec2(p)), up = std::abs(p.z) - half_;
        if (in_plane <= 0 || up <= 0) return std::max(in_plane, up);
        return length(dvec2(in_plane, up));
    }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override;
    Box bounds() const override { return bounds_; }

  private:
    /// Calls visit(a, b) for each side.
    template <typename Visit>
    void for_sides(const Visit& visit) const {
        for (const auto& polygon : polygons_) {
            for (std::size_t i = 0; i < polygon.size(); ++i)
                visit(polygon[i], polygon[(i + 1) % polygon.size()]);
        }
    }
    double plane_distance(dvec2 p) const {
        double nearest = infinity;
        bool is_inside = false;
        for_sides([&](dvec2 a, dvec2 b) {
            const dvec2 way = b - a;
            const double square = dot(way, way);
            const double t = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
            nearest = std::min(nearest, squared_length(p - a - t * way));
            if ((a.y <= p.y) != (b.y <= p.y) && (cross(way, p - a) > 0) == (b.y > a.y))
                is_inside = !is_inside;
        });
        return is_inside ? -std::sqrt(nearest) : std::sqrt(nearest);
    }

    std::vector<std::vector<dvec2>> polygons_;
    double half_;
    Box bounds_;
};

/// Crossings with sides pair up along the line; a corner belongs to one of its sides.
void Outline::cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const {
    const Interval slab = cut_box(bounds_, p, direction);
    if (slab.empty()) return;
    const dvec2 at(p), way(direction);
    if (way == dvec2(0)) {
        if (plane_distance(at) < 0) inside.push_back(slab);
        return;
    }
    std::vector<double> crossings;
    for_sides([&](dvec2 a, dvec2 b) {
        const double from = cross(way, a - at), to = cross(way, b - at);
        if ((from <= 0) == (to <= 0)) return;
        const dvec2 on_side = a + (b - a) * (from / (from - to));
        crossings.push_back(dot(on_side - at, way) / dot(way, way));
    });
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const Interval part{std::max(crossings[i], slab.lo), std::min(crossings[i + 1], slab.hi)};
        if (part.lo < part.hi) inside.push_back(part);
    }
}

/// A torus.
class Ring : public ElementShape {
  public:
    Ring(double diameter, double width) : torus_{0.5 * (diameter - width), 0.5 * width} {}
    double distance(dvec3 p) const override { return signed_distance(torus_, p); }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override {
        lamella::cut(torus_, p, direction, inside);
    }
    Box bounds() const override { return lamella::bounds(torus_); }

  private:
    Torus torus_;
};

class FieldShape : public ElementShape {
    /// A place along a line, and the distance there.
    struct Crossing {
        double t, value;
    };

  public:
    explicit FieldShape(FieldPtr field)
        : field_(std::move(field)), bounds_(field_->bounds()), least_step_(1e-4 * length(bounds_.size())) {}
    double distance(dvec3 p) const override { return field_->value(p); }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override;
    Box bounds() const override { return bounds_; }

  private:
    double border(dvec3 p, dvec3 way, const Crossing& a, const Crossing& b) const {
        return root_between([&](double t) { return field_->value(p + t * way); }, a.t, a.value, b.t, b.value);
    }

    FieldPtr field_;
    Box bounds_;
    double least_step_;
};

/// No surface is nearer than the distance tells: steps of its length miss nothing but what a least step does.
void FieldShape::cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const {
    const double speed = length(direction);
    const dvec3 way = direction / speed;
    const Box about{bounds_.lo - least_step_, bounds_.hi + least_step_};
    const Interval whole = cut_box(about, p, way);
    if (whole.empty()) return;
    Crossing last{whole.lo, field_->value(p + whole.lo * way)};
    double begin = 0;
    bool was_inside = false;
    for (double t = whole.lo;;) {
        const double value = field_->value(p + t * way);
        const bool is_inside = value < 0 && t < whole.hi;
        const Crossing here{t, value};
        if (is_inside && !was_inside) begin = border(p, way, last, here);
        if (!is_inside && was_inside) inside.push_back({begin / speed, border(p, way, here, last) / speed});
        if (t >= whole.hi) return;
        was_inside = is_inside;
        last = here;
        t = std::min(t + std::max(std::abs(value), least_step_), whole.hi);
    }
}

void check_sizes(const char* name, double large, double small, const char* right) {
    if (small > 0 && large > small && std::isfinite(large)) return;
    throw InputError(std::string("an element's shape: ") + name + "; accepted: " + right);
}

}  // namespace

ElementShapePtr make_stick(double length, double width) {
    check_sizes("a stick that is not longer than it is wide", length, width,
                "a length above the width, both above 0");
    return std::make_shared<Stick>(length, width);
}

ElementShapePtr make_ring(double diameter, double width) {
    check_sizes("a ring without a hole", diameter, 2 * width,
                "a diameter above twice the width, both above 0");
    return std::make_shared<Ring>(diameter, width);
}

ElementShapePtr make_outline(std::vector<std::vector<dvec2>> polygons, double thickness) {
    const bool is_open = polygons.empty() || std::ranges::any_of(polygons, [](const auto& polygon) {
                             return polygon.size() < 3;
                         });
    if (is_open)
        throw InputError("an element's outline has fewer than three corners; accepted: closed polygons");
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError("an element's outline has no thickness; accepted: one above 0");
    return std::make_shared<Outline>(std::move(polygons), thickness);
}

ElementShapePtr make_field_shape(FieldPtr field) {
    const Box box = field->bounds();
    if (box.empty() || !is_finite(box.lo) || !is_finite(box.hi))
        throw InputError("an element's shape is empty or has no bounds; accepted: a solid of finite size");
    if (field->metric() == Metric::sign)
        throw InputError(
            "an element's shape tells no distance; accepted: a mesh, a shape or a formula whose "
            "value does");
    return std::make_shared<FieldShape>(std::move(field));
}

}  // namespace lamella
